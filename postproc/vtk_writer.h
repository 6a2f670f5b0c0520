// ParaView files: .vtp meshes (appended, raw, zlib) and the .pvd that lists them in time. The only part that knows VTK; it
// knows nothing of cells and links.
#pragma once
#include <array>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "generator/sample/vec.h"

namespace lamella {

/// Single precision is enough to look at and halves the files; ids are integers.
struct MeshArray {
  std::string name;  // snake_case
  int components = 1;
  std::variant<std::vector<float>, std::vector<int>> data;
};

/// Points in the plane z = 0, and cells over them: cell k joins points connectivity[offsets[k]] ... [offsets[k + 1] - 1].
struct Mesh {
  enum class Kind { kPolygons, kLines };
  Kind kind = Kind::kPolygons;
  std::vector<Vec2> points;
  std::vector<std::int64_t> offsets{0}, connectivity;
  std::vector<MeshArray> cell_data, point_data;

  /// Closes a cell of the points that were added to the connectivity since the last one.
  void end_cell() { offsets.push_back(static_cast<std::int64_t>(connectivity.size())); }
};

/// One mesh, one file (.vtp). Throws DataError when it cannot be written.
void write_vtp(const std::filesystem::path& path, const Mesh& mesh, double time = 0);

/// A time series: NAME.pvd in a folder and NAME_0000.vtp, ... in its subfolder vtk/.
class VtkSeries {
 public:
  VtkSeries(std::filesystem::path folder, std::string name);
  /// Times must increase strictly. Every mesh must bring the same arrays: ParaView takes their list from the first.
  void add(double time, const Mesh& mesh);
  /// Writes the .pvd, removes meshes of an earlier, longer series, and returns the .pvd's path.
  std::filesystem::path finish();

 private:
  std::filesystem::path file(std::size_t index) const;
  std::filesystem::path folder_;
  std::string name_;
  std::vector<double> times_;
};

}  // namespace lamella
