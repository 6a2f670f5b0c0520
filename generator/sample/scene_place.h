// Where in a scene stands what a fault is about, when the fault is found after the scene was read.
#pragma once
#include <string>
#include <vector>

#include "generator/sample/scene.h"

namespace lamella {

/// Faults that begin with a key of [sample], such as "sample.domain.holes[1]: ...", with the place of that key in front, of
/// its section where it is not given: "tissue.toml:12: ...", or the --set that gives it. Others as they are.
std::vector<std::string> with_places(const Scene& scene, std::vector<std::string> faults);

}  // namespace lamella
