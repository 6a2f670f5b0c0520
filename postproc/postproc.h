// The front door of post-processing: a trajectory in, everything that is looked at out. All of it is derived from the
// trajectory alone.
#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "postproc/summary.h"

namespace lamella {

struct PostOptions {
  bool vtk = true;                                           // ParaView files
  bool pictures = true;                                      // PNG and PDF, and the report that contains them
  std::vector<Quantity> accuracy{};                          // known before: joins the group "accuracy" of the summary
  std::function<void(double, const std::string&)> progress;  // done in [0, 1], and what is being done
};

struct PostResult {
  std::vector<std::filesystem::path> files;  // written, those for the reader first: report, pictures, tables, .pvd
  Summary summary;
};

/// Writes into `folder` (made if need be): cells.pvd, walls.pvd and, where the scene has them, links.pvd, contacts.pvd, cracks.pvd
/// with their meshes in vtk/, view.py; response.csv, events.csv, summary.json; snapshots, final state, crack path, stress-strain
/// curve and energy ledger as PNG and PDF; report.html. Each file is complete or as it was. Throws DataError.
PostResult post(const std::filesystem::path& trajectory, const std::filesystem::path& folder,
                const PostOptions& options);

}  // namespace lamella
