// Groups of mass points, as scenes name them.
#pragma once
#include <vector>

#include "generator/sample/sample.h"
#include "generator/sample/scene.h"

namespace lamella {

/// Nodes of a selection, ascending and each once. Throws SceneError when it names what is not there (and lists what
/// is), or selects nothing. The ends of a chain: start and end are its first and last node, clamp_start and
/// clamp_end its first and last two (the ghost segment beyond a clamp), middle the node nearest to half its length.
std::vector<Index> select_nodes(const Sample& sample, const Selection& selection);

}  // namespace lamella
