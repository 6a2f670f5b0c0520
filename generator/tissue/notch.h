// A cut in a tissue that is already made.
#pragma once
#include <vector>

#include "generator/generate.h"
#include "generator/sample/sample.h"

namespace lamella {

/// Removes every link that the polyline `line` crosses: those of two cells whose centres the line parts, and those
/// that it cuts themselves. Walls stay. Throws SceneError when it crosses none.
void cut_links(const std::vector<Vec2>& line, Sample& sample, Notes& notes);

}  // namespace lamella
