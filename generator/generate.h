// The generator's front door: a scene in, a sample out.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "generator/sample/sample.h"
#include "generator/sample/scene.h"

namespace lamella {

/// Facts that the user should see: what was welded, hidden, dropped or merged, the shortest segment and what it costs.
using Notes = std::vector<std::string>;

/// Makes the sample that the scene asks for; same scene and seed, same sample, bit for bit.
/// `progress(done, what)` is called with done in [0, 1]. Throws SceneError where the scene cannot be met.
Sample generate(const Scene& scene, Notes& notes, const std::function<void(double, const std::string&)>& progress = {});

/// Invariants of a sample, as a list of violations (empty: all hold). Those that apply: areas sum to the box, walls closed
/// and counter-clockwise, links mutual and facing, no shell crosses itself or another, rest data finite and positive,
/// indices in range.
std::vector<std::string> check_sample(const Sample& sample);

}  // namespace lamella
