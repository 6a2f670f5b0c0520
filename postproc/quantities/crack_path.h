// Cracks: runs of broken links, joined across the junctions of walls into paths through the tissue.
#pragma once
#include <vector>

#include "postproc/frame_view.h"

namespace lamella {

/// A path without branches.
struct CrackLine {
  std::vector<Index> links;  // broken, in order
  std::vector<Vec2>
      points;  // middles of the links, with the junctions between walls, now [m]; on beyond a side that repeats
  std::vector<Vec2> reference;  // the same at rest [m]
  double length = 0;            // sum of the tributary lengths of its links, at rest [m]
  double opening = 0;           // normal distance beyond the rest distance, mean over the length [m]
  double first_time = 0;        // of its earliest break [s]
  double last_time = 0;         // of its latest break [s]
};

/// A connected piece: its main line first, then its branches. The main line runs from one free side to the other where
/// the crack touches both, or, where the sample repeats there, once around; it is the longest of the shortest paths otherwise.
struct Crack {
  std::vector<CrackLine> lines;
  double length = 0;   // of all lines [m]
  double opening = 0;  // mean over the length [m]
  double first_time = 0;
  int links = 0;
  bool from_side_to_side = false;  // touches both free sides, or goes around
};

/// The graph of walls and junctions of a sample, made once. A junction is where the end links of walls share corner nodes.
class CrackFinder {
 public:
  /// The free sides are those across `free_axis` (0: left and right).
  CrackFinder(const Sample& sample, int free_axis);
  /// Longest crack first.
  std::vector<Crack> find(const FrameView& view) const;

 private:
  struct Run;
  struct Places;
  std::vector<Run> broken_runs(const FrameView& view) const;
  Places places_of_junctions(const FrameView& view, const std::vector<Run>& runs) const;
  Vec2 middle(Index link) const;
  Vec2 middle(Index link, const FrameView& view) const;
  Vec2 towards(const Vec2& place, const Vec2& near) const;
  int around(const Run& run, const Places& places) const;
  CrackLine make_line(const FrameView& view, const std::vector<Run>& runs, const Places& places,
                      const std::vector<Index>& path) const;

  const Sample* sample_;
  int free_axis_;
  std::vector<Index> wall_begin_;   // links of wall w: [wall_begin_[w], wall_begin_[w + 1])
  std::vector<Index> junction_of_;  // of node; -1: at no end of a wall
  Index junctions_ = 0;
  std::vector<std::uint8_t> junction_sides_;  // free sides that it lies on: 1 low, 2 high
};

/// Root mean square distance of the line's reference from its best straight line (total least squares, points weighted by the
/// length that they stand for) [m].
double roughness(const CrackLine& line);
/// Length along the line over the distance of its ends, at rest; 1 for a straight crack.
double tortuosity(const CrackLine& line);

}  // namespace lamella
