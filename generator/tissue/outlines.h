// Outlines of cells as candidate mass points, and what becomes of them: points that lie too close are merged, cells and
// links are written into a sample. Knows nothing of where the candidates come from.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "generator/generate.h"
#include "generator/sample/sample.h"

namespace lamella {

/// A candidate for a mass point. Merged candidates become one mass point at the mean of those of the highest kind.
struct OutlineNode {
  enum class Kind { fill, matched, corner };
  Vec2 at = Vec2::Zero();
  Kind kind = Kind::fill;
  Index pair = -1;        // matched: into Bonding::pairs
  std::uint8_t side = 0;  // Side bits
  bool first_side =
      false;  // matched: of the side of a in the pair, which of a cell beside its own image both cells are
};

/// A closed cell to be, counter-clockwise.
struct Outline {
  std::vector<OutlineNode> nodes;
  double tile_area = 0;  // [m2]
  std::string name;      // what the user calls it
};

/// Two facing mass points of two cells.
struct FacingPair {
  double length = 0;   // tributary [m]
  double spacing = 0;  // of its wall [m]
  bool linked = true;
};

/// The contact line of two cells, cell_a < cell_b, or of a cell and an image of its own: pairs [first, first + count) in the order of a's outline.
struct FacingWall {
  Index cell_a = 0, cell_b = 0;
  double length = 0;              // [m]
  Vec2 direction = Vec2::Zero();  // of the line, as a runs along it
  Index first = 0, count = 0;
  Image image{0, 0};  // by which b is displaced where it borders a
};

struct Bonding {
  std::vector<Outline> cells;
  std::vector<FacingWall> walls;
  std::vector<FacingPair> pairs;
  double spacing = 0;  // asked [m]
};

/// Candidates closer than this fraction of the spacing are merged.
inline constexpr double kMergeFraction = 0.25;

/// Appends cells, walls and links to the sample; all links are stress-free. Throws SceneError naming cells that are
/// too small for the spacing. Notes say how many points were merged and what the shortest segment costs.
void add_bonded_cells(const Bonding& bonding, double radius, const std::string& group, Sample& sample, Notes& notes);

/// One note on the shortest segment of the sample and on what it costs in time step; nothing when segments are equal.
void note_shortest_segment(const Sample& sample, const std::vector<std::string>& cell_names, Notes& notes);

/// Up to ten names, then how many more: "site 3, site 9, ... and 12 more".
std::string listed(const std::vector<std::string>& names);

}  // namespace lamella
