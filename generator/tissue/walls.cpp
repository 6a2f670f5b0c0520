#include "generator/tissue/walls.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "generator/sample/errors.h"
#include "generator/sample/parallel.h"
#include "generator/tissue/inset_sides.h"

namespace lamella {
namespace {

/// Below this fraction of the spacing two sides do not face each other in any useful sense: no link.
constexpr double kLeastOverlap = 0.05;

/// Places the pairs of one wall piece. Returns how many.
Index add_pairs(double length, double spacing, Bonding& bonding) {
  if (length < kLeastOverlap * spacing) return 0;
  if (length < kMergeFraction * spacing) {
    bonding.pairs.push_back({length, length, true});
    return 1;
  }
  const auto segments = std::max<Index>(1, static_cast<Index>(std::lround(length / spacing)));
  const double step = length / segments;
  for (Index k = 0; k <= segments; ++k)
    bonding.pairs.push_back({k == 0 || k == segments ? step / 2 : step, step, true});
  return segments + 1;
}

/// Keeps links only where the scene asks for them. Links at the ends only share the wall between the two.
void choose_links(const std::string& links, Bonding& bonding) {
  if (links == "all") return;
  for (const FacingWall& wall : bonding.walls) {
    double total = 0;
    for (Index p = wall.first; p < wall.first + wall.count; ++p) {
      total += bonding.pairs[p].length;
      bonding.pairs[p].linked = false;
    }
    if (links == "none") continue;
    const Index last = wall.first + wall.count - 1;
    const double share = wall.count > 1 ? total / 2 : total;
    for (const Index p : {wall.first, last}) bonding.pairs[p] = {share, total, true};
  }
}

/// Finds the facing part of every shared edge and gives it pairs. Consecutive edges between the same two cells, through the same image,
/// are one wall.
void face_sides(const Mosaic& mosaic, const std::vector<std::vector<EdgePlace>>& opposite, Sides& sides,
                Bonding& bonding, Notes& notes) {
  std::vector<std::string> one_sided, apart, single;
  for (std::size_t c = 0; c < sides.size(); ++c) {
    const std::size_t count = sides[c].size();
    const auto cell = static_cast<Index>(c);
    // Begin where the neighbour changes, so that a wall of several edges is not cut in two.
    std::size_t start = 0;
    const auto neighbour = [&](std::size_t k) { return std::pair(opposite[c][k].cell, opposite[c][k].image); };
    while (start < count && neighbour(start) == neighbour((start + count - 1) % count)) ++start;
    std::pair<Index, Image> before{-1, {0, 0}};
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t k = (start + i) % count;
      const EdgePlace there = opposite[c][k];
      if (!comes_first(cell, there)) {
        before.first = -1;
        continue;
      }
      InsetSide& here = sides[c][k];
      InsetSide& across = sides[there.cell][there.edge];
      const std::string name = mosaic.cells[c].name + " - " + mosaic.cells[there.cell].name;
      if (!here.present || !across.present) {
        if (here.present || across.present) one_sided.push_back(name);
        continue;
      }
      const double length = edge_length(here, across, displacement(there.image, mosaic.box));
      double low, high;
      overlap(here, across, length, low, high);
      const auto first = static_cast<Index>(bonding.pairs.size());
      const Index pairs = high > low ? add_pairs(high - low, bonding.spacing, bonding) : 0;
      if (pairs == 0) {
        apart.push_back(name);
        continue;
      }
      if (pairs == 1) single.push_back(name);
      here.first_pair = across.first_pair = first;
      here.pairs = across.pairs = pairs;
      here.low = low;
      here.high = high;
      across.low = length - high;
      across.high = length - low;
      if (before == neighbour(k)) {
        bonding.walls.back().length += length;
        bonding.walls.back().count += pairs;
      } else {
        bonding.walls.push_back({cell, there.cell, length, here.along, first, pairs, there.image});
        before = neighbour(k);
      }
    }
  }
  if (!one_sided.empty())
    notes.push_back(fmt::format("{} walls have one side only, the other vanishes by the inset: {}", one_sided.size(),
                                listed(one_sided)));
  if (!apart.empty())
    notes.push_back(fmt::format("{} walls get no link, their two sides do not face each other over {} spacings: {}",
                                apart.size(), kLeastOverlap, listed(apart)));
  if (!single.empty())
    notes.push_back(
        fmt::format("{} walls get a single link, their two sides face each other over less than {} spacings: {}",
                    single.size(), kMergeFraction, listed(single)));
}

class OutlineWriter {
 public:
  OutlineWriter(const InsetSide& side, double distance, double spacing, std::uint8_t bits, bool first_side,
                Outline& outline)
      : side_(side),
        normal_(left_of(side.along)),
        distance_(distance),
        spacing_(spacing),
        bits_(bits),
        first_side_(first_side),
        outline_(outline) {}

  void corner(std::uint8_t bits_before) {
    outline_.nodes.push_back(
        {at(side_.from), OutlineNode::Kind::corner, -1, static_cast<std::uint8_t>(bits_ | bits_before)});
  }
  /// Evenly spaced points strictly between two positions.
  void fill(double from, double to) {
    const auto segments = std::lround((to - from) / spacing_);
    for (long k = 1; k < segments; ++k)
      outline_.nodes.push_back({at(from + (to - from) * static_cast<double>(k) / static_cast<double>(segments)),
                                OutlineNode::Kind::fill, -1, bits_});
  }
  void matched(double position, Index pair) {
    outline_.nodes.push_back({at(position), OutlineNode::Kind::matched, pair, bits_, first_side_});
  }

 private:
  Vec2 at(double position) const { return side_.start + position * side_.along + distance_ * normal_; }

  const InsetSide& side_;
  Vec2 normal_;
  double distance_, spacing_;
  std::uint8_t bits_;
  bool first_side_;
  Outline& outline_;
};

/// The candidates for mass points of a cell: corners of its inset sides, facing points, and what fills the rest.
Outline outline_of(const Mosaic& mosaic, Index c, const std::vector<EdgePlace>& opposite,
                   const std::vector<InsetSide>& sides, double distance, double spacing) {
  const MosaicCell& cell = mosaic.cells[c];
  Outline outline;
  outline.name = cell.name;
  outline.tile_area = polygon_area(polygon_of(mosaic, cell));
  const std::size_t count = sides.size();
  std::uint8_t bits_before = 0;
  for (std::size_t k = count; k-- > 0 && bits_before == 0;)
    if (sides[k].present) {
      bits_before = cell.side[k];
      break;
    }
  for (std::size_t k = 0; k < count; ++k) {
    const InsetSide& side = sides[k];
    if (!side.present) continue;
    const bool first_cell = comes_first(c, opposite[k]);
    OutlineWriter writer(side, distance, spacing, cell.side[k], first_cell, outline);
    writer.corner(bits_before);
    bits_before = cell.side[k];
    if (!side.faces()) {
      writer.fill(side.from, side.to);
      continue;
    }
    writer.fill(side.from, side.low);
    for (Index p = 0; p < side.pairs; ++p) {
      const double share = side.pairs > 1 ? static_cast<double>(p) / (side.pairs - 1) : 0.5;
      // Measured from the end that both cells measure from, so that the two points of a pair face each other exactly.
      const double position =
          first_cell ? side.low + share * (side.high - side.low) : side.high - (1 - share) * (side.high - side.low);
      writer.matched(position, side.first_pair + (first_cell ? p : side.pairs - 1 - p));
    }
    writer.fill(side.high, side.to);
  }
  return outline;
}

}  // namespace

Bonding face_walls(const Mosaic& mosaic, const WallsScene& walls, double radius, Notes& notes) {
  return face_walls(mosaic, walls, std::vector<double>(mosaic.cells.size(), radius), notes);
}

Bonding face_walls(const Mosaic& mosaic, const WallsScene& walls, const std::vector<double>& radius, Notes& notes) {
  std::vector<double> distance = radius;
  for (double& d : distance) d += walls.gap / 2;
  const auto opposite = opposite_edges(mosaic);
  Sides sides = inset_sides(mosaic, distance, notes);
  Bonding bonding;
  bonding.spacing =
      walls.spacing > 0 ? walls.spacing : mean_overlap(sides, opposite, mosaic.box) / std::max(1, walls.segments);
  refuse_too_many(sides, bonding.spacing);
  face_sides(mosaic, opposite, sides, bonding, notes);
  choose_links(walls.links, bonding);

  bonding.cells.resize(mosaic.cells.size());
  for_pieces(mosaic.cells.size(), kCellsOfPiece, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c)
      bonding.cells[c] = outline_of(mosaic, static_cast<Index>(c), opposite[c], sides[c], distance[c], bonding.spacing);
  });
  return bonding;
}

Sample make_tissue(const Mosaic& mosaic, const WallsScene& walls, double radius, const std::string& group,
                   Notes& notes) {
  Sample sample;
  sample.box = mosaic.box;
  sample.periodic = mosaic.periodic;
  const Bonding bonding = face_walls(mosaic, walls, radius, notes);
  add_bonded_cells(bonding, radius, group, sample, notes);
  return sample;
}

Sample make_tissue(const Mosaic& mosaic, const WallsScene& walls, const RadiusOfGroup& radius_of, Notes& notes) {
  Sample sample;
  sample.box = mosaic.box;
  sample.periodic = mosaic.periodic;
  std::vector<double> radius;
  bool vary = false;
  for (const MosaicCell& cell : mosaic.cells) {
    radius.push_back(radius_of(cell.group) * cell.thickness);
    vary = vary || cell.thickness != 1;
  }
  add_bonded_cells(face_walls(mosaic, walls, radius, notes), 0, "", sample, notes);
  sample.radius = radius;
  sample.group_names.clear();
  for (std::size_t c = 0; c < mosaic.cells.size(); ++c) {
    auto& names = sample.group_names;
    const auto known = std::find(names.begin(), names.end(), mosaic.cells[c].group);
    sample.group[c] = static_cast<Index>(known - names.begin());
    if (known == names.end()) names.push_back(mosaic.cells[c].group);
    if (vary) sample.cell_thickness.push_back(mosaic.cells[c].thickness);
  }
  return sample;
}

}  // namespace lamella
