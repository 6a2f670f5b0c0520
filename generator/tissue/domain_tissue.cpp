#include "generator/tissue/domain_tissue.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "generator/sample/errors.h"
#include "generator/tissue/outlines.h"

namespace lamella {
namespace {

constexpr double kSliver = 1e-7;  // of the mean cell's area: what rounding leaves beside a wall on the boundary

double length_of(const Overlay& o, Index e) {
  return (o.points[o.edges[o.edges[e].next].from] - o.points[o.edges[e].from]).norm();
}

/// Shares pieces out to cells: one cell for each tile.
class Sharing {
 public:
  Sharing(const Overlay& overlay, std::size_t tiles) : o_(overlay), cell_(overlay.pieces.size(), -1), pieces_(tiles) {}

  /// The largest piece of each tile is its cell.
  void keep_largest(double sliver) {
    for (std::size_t p = 0; p < o_.pieces.size(); ++p) {
      const Piece& piece = o_.pieces[p];
      if (piece.area <= sliver) continue;
      auto& of_tile = pieces_[piece.tile];
      if (of_tile.empty())
        of_tile.push_back(static_cast<Index>(p));
      else if (piece.area > o_.pieces[of_tile.front()].area)
        of_tile.front() = static_cast<Index>(p);
    }
    for (std::size_t t = 0; t < pieces_.size(); ++t)
      if (!pieces_[t].empty()) cell_[pieces_[t].front()] = static_cast<Index>(t);
  }

  /// Gives the other pieces away, largest first. `given(piece, cell)` hears of each. Returns those that nobody can take.
  template <class Given>
  std::vector<Index> give_away(Given&& given) {
    std::vector<Index> left;
    for (std::size_t p = 0; p < o_.pieces.size(); ++p)
      if (cell_[p] < 0) left.push_back(static_cast<Index>(p));
    std::stable_sort(left.begin(), left.end(), [&](Index p, Index q) { return o_.pieces[p].area > o_.pieces[q].area; });
    for (bool any = true; any && !left.empty();) {
      any = false;
      std::vector<Index> rest;
      for (const Index p : left) {
        const Index cell = give(p);
        if (cell < 0) {
          rest.push_back(p);
          continue;
        }
        any = true;
        given(p, cell);
      }
      left = std::move(rest);
    }
    return left;
  }

  /// Edges around a cell, counter-clockwise; empty when they are not one ring that touches itself nowhere.
  std::vector<Index> outline(Index cell) const {
    std::vector<Index> ring;
    std::size_t outer = 0;
    for (const Index p : pieces_[cell])
      visit(p, [&](Index e) {
        if (inside(cell, e)) return;
        ++outer;
        if (ring.empty()) ring.push_back(e);
      });
    if (ring.empty()) return {};
    for (Index e = following(cell, ring.front()); e != ring.front(); e = following(cell, e)) ring.push_back(e);
    std::vector<Index> from;
    for (const Index e : ring) from.push_back(o_.edges[e].from);
    std::sort(from.begin(), from.end());
    const bool touches = std::adjacent_find(from.begin(), from.end()) != from.end();
    return ring.size() == outer && !touches ? ring : std::vector<Index>();
  }

  bool has_cell(Index tile) const { return !pieces_[tile].empty(); }

 private:
  template <class Visit>
  void visit(Index piece, Visit&& see) const {
    Index e = o_.pieces[piece].first;
    do {
      see(e);
      e = o_.edges[e].next;
    } while (e != o_.pieces[piece].first);
  }

  /// Whether the edge parts two pieces of the cell.
  bool inside(Index cell, Index e) const {
    const Index twin = o_.edges[e].twin;
    return twin >= 0 && cell_[o_.edges[twin].piece] == cell;
  }

  Index following(Index cell, Index e) const {
    Index next = o_.edges[e].next;
    while (inside(cell, next)) next = o_.edges[o_.edges[next].twin].next;
    return next;
  }

  /// To the cell with the longest common wall of those that stay one polygon with it.
  Index give(Index piece) {
    std::map<Index, double> common;
    visit(piece, [&](Index e) {
      const Index twin = o_.edges[e].twin;
      if (twin < 0) return;
      if (const Index cell = cell_[o_.edges[twin].piece]; cell >= 0) common[cell] += length_of(o_, e);
    });
    std::vector<std::pair<double, Index>> best;
    for (const auto& [cell, length] : common) best.emplace_back(-length, cell);
    std::sort(best.begin(), best.end());
    for (const auto& [length, cell] : best) {
      cell_[piece] = cell;
      pieces_[cell].push_back(piece);
      if (!outline(cell).empty()) return cell;
      pieces_[cell].pop_back();
      cell_[piece] = -1;
    }
    return -1;
  }

  const Overlay& o_;
  std::vector<Index> cell_;                 // per piece: the tile whose cell it belongs to
  std::vector<std::vector<Index>> pieces_;  // per tile
};

std::string place_of(const Vec2& p) { return fmt::format("({:.6g}, {:.6g})", p.x(), p.y()); }

void refuse_lone_holes(const Overlay& o, const Tessellation& t, const std::vector<std::string>& keys) {
  std::vector<std::string> faults;
  for (const Piece& piece : o.pieces)
    if (piece.lone_loop > 0)
      faults.push_back(fmt::format(
          "{}: lies within the cell of site {}, which cannot have a hole: make it larger, move it, leave "
          "it out, or ask for more cells",
          keys.empty() ? fmt::format("sample.domain.holes[{}]", piece.lone_loop - 1) : keys[piece.lone_loop],
          t.tiles[piece.tile].site));
  if (!faults.empty()) throw SceneError(faults);
}

DomainTissue tissue_of(const Overlay& o, const Tessellation& t, const Sharing& sharing) {
  DomainTissue tissue;
  std::vector<Index> id(o.points.size(), -1);
  for (std::size_t k = 0; k < t.tiles.size(); ++k) {
    MosaicCell cell;
    std::vector<Index> boundary;
    for (const Index e : sharing.outline(static_cast<Index>(k))) {
      const Index from = o.edges[e].from;
      if (id[from] < 0) {
        id[from] = static_cast<Index>(tissue.mosaic.vertices.size());
        tissue.mosaic.vertices.push_back(o.points[from]);
        tissue.lies_on.push_back(o.lies_on[from]);
      }
      cell.vertex.push_back(id[from]);
      boundary.push_back(o.edges[e].boundary);
    }
    if (cell.vertex.empty()) continue;
    cell.side.assign(cell.vertex.size(), 0);
    cell.name = fmt::format("site {}", t.tiles[k].site);
    cell.number = t.tiles[k].site;
    tissue.mosaic.cells.push_back(std::move(cell));
    tissue.boundary.push_back(std::move(boundary));
    tissue.site.push_back(t.tiles[k].site);
  }
  return tissue;
}

void report_without_cell(const Tessellation& t, const Sharing& sharing, Hidden hidden,
                         std::vector<std::string>& notes) {
  std::vector<std::string> names;
  for (std::size_t k = 0; k < t.tiles.size(); ++k)
    if (!sharing.has_cell(static_cast<Index>(k))) names.push_back(fmt::format("site {}", t.tiles[k].site));
  if (names.empty()) return;
  if (hidden == Hidden::kRefuse)
    throw SceneError(fmt::format("sample.domain: the tiles of {} lie outside: remove these disks, or move them inside",
                                 listed(names)));
  notes.push_back(
      fmt::format("{} sites have no cell, their tiles lie outside the domain: {}", names.size(), listed(names)));
}

}  // namespace

Box box_around(const Loops& loops, const std::vector<Disk>& disks) {
  Box box{loops.front().front(), loops.front().front()};
  const auto include = [&](const Vec2& p) {
    box.lo = box.lo.cwiseMin(p);
    box.hi = box.hi.cwiseMax(p);
  };
  for (const auto& loop : loops)
    for (const Vec2& p : loop) include(p);
  for (const Disk& disk : disks) include(disk.centre);
  const Vec2 margin = Vec2::Constant(0.1 * box.size().maxCoeff());
  return {box.lo - margin, box.hi + margin};
}

DomainTissue clip_tiles(const Tessellation& tessellation, const Loops& loops, const LaguerreOptions& options,
                        std::vector<std::string>& notes, const std::vector<std::string>& keys) {
  const Overlay o = overlay(tessellation, loops);
  refuse_lone_holes(o, tessellation, keys);
  if (o.moved)
    notes.push_back(
        "the boundary of the domain passes through a vertex or along a wall of the tissue: such coincidences were "
        "decided as if its corners lay elsewhere by 1e-9 cell sizes");
  double area = 0;
  for (const Piece& piece : o.pieces) area += piece.area;
  const double sliver = kSliver * area / static_cast<double>(tessellation.tiles.size());
  Sharing sharing(o, tessellation.tiles.size());
  sharing.keep_largest(sliver);
  report_without_cell(tessellation, sharing, options.hidden, notes);
  std::vector<std::string> given;
  const auto left = sharing.give_away([&](Index p, Index cell) {
    const Piece& piece = o.pieces[p];
    if (piece.area <= sliver || !sharing.has_cell(piece.tile)) return;
    given.push_back(fmt::format("{:.3g} m2 of site {} to site {}", piece.area, tessellation.tiles[piece.tile].site,
                                tessellation.tiles[cell].site));
  });
  if (!left.empty()) {
    const Piece& piece = o.pieces[left.front()];
    throw SceneError(fmt::format(
        "sample.domain: the boundary cuts a piece of {:.3g} m2 off the cell of site {} at {}, which no neighbour can "
        "take: make the domain wider there, or ask for more cells",
        piece.area, tessellation.tiles[piece.tile].site, place_of(o.points[o.edges[piece.first].from])));
  }
  if (!given.empty())
    notes.push_back(
        fmt::format("the boundary cuts {} pieces off their cells; they went to the neighbour with the "
                    "longest common wall: {}",
                    given.size(), listed(given)));
  DomainTissue tissue = tissue_of(o, tessellation, sharing);
  tissue.outer_edges = static_cast<Index>(loops.front().size());
  Box& box = tissue.mosaic.box;
  box = {loops.front().front(), loops.front().front()};
  for (const Vec2& p : loops.front()) box.lo = box.lo.cwiseMin(p), box.hi = box.hi.cwiseMax(p);
  return tissue;
}

double mean_wall_length(const DomainTissue& tissue) {
  double sum = 0, sides = 0;
  for (std::size_t c = 0; c < tissue.mosaic.cells.size(); ++c) {
    const auto points = polygon_of(tissue.mosaic, tissue.mosaic.cells[c]);
    for (std::size_t k = 0; k < points.size(); ++k)
      if (tissue.boundary[c][k] < 0) sum += (points[(k + 1) % points.size()] - points[k]).norm(), ++sides;
  }
  return sides > 0 ? sum / sides : 0;
}

void mark_outer_sides(DomainTissue& tissue) {
  mark_rough_sides(tissue.mosaic);
  for (std::size_t c = 0; c < tissue.mosaic.cells.size(); ++c)
    for (std::size_t k = 0; k < tissue.boundary[c].size(); ++k)
      if (tissue.boundary[c][k] >= tissue.outer_edges) tissue.mosaic.cells[c].side[k] = 0;
}

}  // namespace lamella
