// The numerical knobs of a run, chosen for the error that the user accepts: pace, drag and step. Where the rules come from, and what they
// cost, is measured in docs/accuracy.md.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "generator/sample/sample.h"
#include "generator/sample/scene.h"

namespace lamella {

struct Choice {
  std::optional<double> frequency;      // lowest of the sample, of its first stage [rad/s]
  std::optional<double> drag;           // [1/s]; empty: the scene says how it is damped
  std::optional<double> step_fraction;  // of the stable step; empty: the scene fixes the step
  double slowdown = 1;
  // A scene at rest has no pace: how many times finer than the coarsest its tolerances and load steps are; empty: a scene in time.
  std::optional<double> fineness;

  /// By what the error falls: pace or fineness.
  double effort() const { return fineness.value_or(slowdown); }
  /// With so many times the effort.
  Choice times(double factor) const;
  /// As `--set` takes them: the same run, by hand.
  std::vector<std::string> settings() const;
  /// One sentence for the user.
  std::string sentence() const;
};

/// For an accepted error. Throws SceneError where nothing that is prescribed could be slowed down.
Choice first_choice(const Sample& sample, const Scene& scene, double accepted);

/// Whether `runs` more runs, each slower, could bring the error down to what is accepted: it falls with the pace at best.
bool within_reach(double estimated, double accepted, int runs);
/// A slower pace, after the error at the present one was estimated.
Choice slower(const Choice& choice, double estimated, double accepted);

}  // namespace lamella
