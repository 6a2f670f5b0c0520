#include "postproc/view_script.h"

#include <fmt/format.h>

namespace lamella {

std::string view_script(const std::string& colour_by, const std::string& legend, Overlay overlay) {
  std::string script = fmt::format(R"py(# Shows the run in ParaView: cells coloured by their energy, cracks on top.
#   paraview --script=view.py              opens it in the window (or Tools > Python Shell > Run Script)
#   pvpython view.py picture.png           writes a picture of the last frame
import os
import sys

from paraview.simple import *

try:
    here = os.path.dirname(os.path.abspath(__file__))
except NameError:  # some versions run scripts without a name
    here = os.getcwd()

view = GetActiveViewOrCreate("RenderView")
view.InteractionMode = "2D"
view.OrientationAxesVisibility = 0
view.UseColorPaletteForBackground = 0
view.Background = [1.0, 1.0, 1.0]
view.ViewSize = [1200, 900]

cells = PVDReader(registrationName="cells", FileName=os.path.join(here, "cells.pvd"))
shown = Show(cells, view)
times = cells.TimestepValues if hasattr(cells.TimestepValues, "__len__") else [cells.TimestepValues]
scene = GetAnimationScene()
scene.UpdateAnimationUsingDataTimeSteps()
scene.AnimationTime = times[-1]

# One scale for all frames, so that colours can be compared.
largest = 0.0
for time in times:
    cells.UpdatePipeline(time)
    largest = max(largest, cells.CellData["{0}"].GetRange()[1])
ColorBy(shown, ("CELLS", "{0}"))
table = GetColorTransferFunction("{0}")
table.ApplyPreset("Viridis (matplotlib)", True)
table.RescaleTransferFunction(0.0, largest if largest > 0.0 else 1.0)
shown.SetScalarBarVisibility(view, True)
bar = GetScalarBar(table, view)
bar.Title = "{1}"
bar.ComponentTitle = ""
bar.TitleColor = bar.LabelColor = [0.1, 0.1, 0.1]

walls = PVDReader(registrationName="walls", FileName=os.path.join(here, "walls.pvd"))
lines = Show(walls, view)
lines.ColorArrayName = ["POINTS", ""]
lines.AmbientColor = lines.DiffuseColor = [0.1, 0.1, 0.12]
lines.LineWidth = 1.0
)py",
                                   colour_by, legend);
  if (overlay == Overlay::kCracks)
    script += R"(
cracks = PVDReader(registrationName="cracks", FileName=os.path.join(here, "cracks.pvd"))
paths = Show(cracks, view)
paths.ColorArrayName = ["POINTS", ""]
paths.AmbientColor = paths.DiffuseColor = [0.9, 0.2, 0.15]
paths.LineWidth = 3.0
)";
  script += R"(
view.ViewTime = times[-1]
ResetCamera(view)
Render(view)
if len(sys.argv) > 1 and sys.argv[-1].endswith(".png"):
    SaveScreenshot(sys.argv[-1], view, ImageResolution=[1200, 900])
)";
  return script;
}

}  // namespace lamella
