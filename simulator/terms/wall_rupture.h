// Walls that break. A bar whose tension or elongation reaches its strength is gone for good, and with it the hinges at both its ends,
// which need two segments, their dashpots, and the core of the cell, which is a chain from then on.
//
// WHERE DOES A BAR BREAK? In `break_exceeded`, here, and nowhere else. It halves the forces that end, in the step of the break, as
// links do (cohesive_links.h); `end` then takes them out of the terms.
#pragma once
#include <functional>

#include "generator/sample/broken_bars.h"
#include "simulator/terms/bars.h"
#include "simulator/terms/core.h"
#include "simulator/terms/dashpots.h"
#include "simulator/terms/hinges.h"

namespace lamella {

/// Per cell; infinite where none. Either list may be empty: no cell has such a limit.
struct WallStrength {
  std::vector<double> force;   // tension [N]
  std::vector<double> strain;  // (l - l0) / l0 [1]
};

/// A bar that has just broken.
struct WallBreak {
  Index bar = 0, cell = 0;
  double tension = 0;            // at the break [N]
  double energy = 0;             // what bar, hinges and core lose; then less what contact and links gain [J]
  double pressure_work = 0;      // done so far by a pressure that was held constant [J]; ends with the cell
  Vec2 position = Vec2::Zero();  // middle of the bar [m]
};

class WallRupture {
 public:
  /// What ends with a bar. Null where the model has no such thing.
  struct Parts {
    Bars* bars = nullptr;
    Hinges* hinges = nullptr;
    Core* core = nullptr;
    Dashpots* dashpots = nullptr;
  };
  WallRupture(const ShellLayout& layout, const WallStrength& strength, const Parts& parts);

  /// Whether a bar of the block exceeds its strength. `scratch` must hold what the bars have just computed.
  bool exceeded(const ShellScratch& scratch) const;
  /// Finds those bars, all judged on this one configuration, and says of each node by how much less [N] it is pulled in the step of the
  /// break: by half of the forces that end. Changes nothing: `end` does, once all bars of the step are found.
  using Drop = std::function<void(Index node, const Vec2& force)>;
  void break_exceeded(const ShellScratch& scratch, const Drop& drop, std::vector<WallBreak>& breaks) const;
  // ---- at rest: one bar at a time ----
  struct Loaded {
    double zeta = -1;  // the larger of tension over strength and elongated length over the longest, less 1
    Index cell = -1, bar = -1;
  };
  /// The bar that is nearest to its strength at x, or furthest beyond it. `scratch` is scratch.
  Loaded most_loaded(const Field& x, ShellScratch& scratch) const;
  /// That bar as it breaks at x, without the energy. Changes nothing: see `end`.
  WallBreak broken_at(const Loaded& loaded, const Field& x, ShellScratch& scratch) const;
  /// The bar is gone from now on.
  void end(Index cell, Index bar, double time);

  const BrokenBars& broken() const { return broken_; }
  double break_time(Index bar) const { return break_time_[bar]; }
  /// False where bars are broken already but no more can break.
  bool breakable() const { return !force_.empty() || !length_.empty(); }

  void save(ArraySet& restart) const;
  /// Ends what was broken. Before the terms take their own history.
  void restore(const ArraySet& restart);
  void add_output(ArraySet& frame) const;
  std::size_t bytes() const;

 private:
  bool exceeds(Index slot, double tension, double length) const;

  const ShellLayout& layout_;
  Parts parts_;
  BrokenBars broken_;
  std::vector<double> break_time_;  // per segment [s]; -1 while intact
  // padded layout; infinite once the bar is gone; empty: no such limit
  std::vector<double> force_;   // [N]
  std::vector<double> length_;  // [m]
};

}  // namespace lamella
