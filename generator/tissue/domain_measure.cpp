#include "generator/tissue/domain_measure.h"

#include <map>

#include "generator/tissue/domain_tissue.h"
#include "generator/tissue/mosaic.h"

namespace lamella {

TileMeasures measure_domain_tiles(const std::vector<Vec2>& centres, const std::vector<double>& weights,
                                  const Loops& loops) {
  std::vector<Disk> disks;
  for (const Vec2& centre : centres) disks.push_back({centre, 0});
  const Tessellation tiles = tessellate(centres, weights, box_around(loops, disks),
                                        {.duplicates = Duplicates::kKeepFirst, .hidden = Hidden::kReport});
  const Overlay pieces = overlay(tiles, loops);
  TileMeasures measures{std::vector<double>(centres.size(), 0), std::vector<Vec2>(centres.size(), Vec2::Zero()), {}};
  for (const Piece& piece : pieces.pieces) {
    const Index site = tiles.tiles[piece.tile].site;
    measures.area[site] += piece.area;
    if (piece.area != 0)
      measures.centroid[site] += piece.area * (polygon_centre(polygon_of(pieces, piece)) - centres[site]);
  }
  for (std::size_t i = 0; i < centres.size(); ++i) {
    if (measures.area[i] > 0)
      measures.centroid[i] /= measures.area[i];
    else
      measures.area[i] = 0, measures.centroid[i].setZero();
    measures.centroid[i] += centres[i];
  }
  std::map<std::pair<Index, Index>, double> length;
  for (const OverlayEdge& edge : pieces.edges) {
    if (edge.twin < 0) continue;
    const Index a = tiles.tiles[pieces.pieces[edge.piece].tile].site,
                b = tiles.tiles[pieces.pieces[pieces.edges[edge.twin].piece].tile].site;
    if (a < b) length[{a, b}] += (pieces.points[pieces.edges[edge.next].from] - pieces.points[edge.from]).norm();
  }
  for (const auto& [sites, sum] : length) measures.walls.push_back({sites.first, sites.second, {0, 0}, sum});
  return measures;
}

}  // namespace lamella
