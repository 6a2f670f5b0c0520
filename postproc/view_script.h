// view.py: the ParaView script that is written beside the .pvd files.
#pragma once
#include <string>

namespace lamella {

enum class Overlay { kNone, kCracks };

/// `colour_by` is a cell array of cells.pvd, `legend` its title.
std::string view_script(const std::string& colour_by, const std::string& legend, Overlay overlay);

}  // namespace lamella
