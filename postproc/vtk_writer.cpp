#include "postproc/vtk_writer.h"

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkTypeInt64Array.h>
#include <vtkXMLPolyDataWriter.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "generator/sample/errors.h"
#include "postproc/output_file.h"

namespace lamella {
namespace {

vtkSmartPointer<vtkDataArray> to_vtk(const MeshArray& array) {
  const auto fill = [&](auto values, const auto& data) -> vtkSmartPointer<vtkDataArray> {
    values->SetName(array.name.c_str());
    values->SetNumberOfComponents(array.components);
    values->SetNumberOfTuples(static_cast<vtkIdType>(data.size()) / array.components);
    std::copy(data.begin(), data.end(), values->GetPointer(0));
    return values;
  };
  if (const auto* floats = std::get_if<std::vector<float>>(&array.data))
    return fill(vtkSmartPointer<vtkFloatArray>::New(), *floats);
  return fill(vtkSmartPointer<vtkIntArray>::New(), std::get<std::vector<int>>(array.data));
}

vtkSmartPointer<vtkTypeInt64Array> to_vtk(const std::vector<std::int64_t>& data) {
  auto values = vtkSmartPointer<vtkTypeInt64Array>::New();
  values->SetNumberOfValues(static_cast<vtkIdType>(data.size()));
  std::copy(data.begin(), data.end(), values->GetPointer(0));
  return values;
}

vtkSmartPointer<vtkPolyData> to_vtk(const Mesh& mesh, double time) {
  auto data = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkFloatArray> places;
  places->SetNumberOfComponents(3);
  places->SetNumberOfTuples(static_cast<vtkIdType>(mesh.points.size()));
  float* place = places->GetPointer(0);
  for (const Vec2& p : mesh.points) {
    *place++ = static_cast<float>(p.x());
    *place++ = static_cast<float>(p.y());
    *place++ = 0;
  }
  vtkNew<vtkPoints> points;
  points->SetData(places);
  data->SetPoints(points);
  vtkNew<vtkCellArray> cells;
  cells->SetData(to_vtk(mesh.offsets), to_vtk(mesh.connectivity));
  switch (mesh.kind) {
    case Mesh::Kind::kPolygons:
      data->SetPolys(cells);
      break;
    case Mesh::Kind::kLines:
      data->SetLines(cells);
      break;
  }
  for (const MeshArray& array : mesh.cell_data) data->GetCellData()->AddArray(to_vtk(array));
  for (const MeshArray& array : mesh.point_data) data->GetPointData()->AddArray(to_vtk(array));
  vtkNew<vtkDoubleArray> time_value;
  time_value->SetName("TimeValue");
  time_value->InsertNextValue(time);
  data->GetFieldData()->AddArray(time_value);
  return data;
}

}  // namespace

void write_vtp(const std::filesystem::path& path, const Mesh& mesh, double time) {
  replace_output(path, [&](const std::filesystem::path& temporary) {
    vtkObject::GlobalWarningDisplayOff();  // its errors become ours below
    vtkNew<vtkXMLPolyDataWriter> writer;
    writer->SetFileName(temporary.c_str());
    writer->SetInputData(to_vtk(mesh, time));
    writer->SetDataModeToAppended();
    writer->EncodeAppendedDataOff();
    writer->SetCompressorTypeToZLib();
    writer->SetCompressionLevel(1);
    if (writer->Write() == 0 || writer->GetErrorCode() != 0)
      throw DataError(path.string() + ": cannot be written; is the disk full, the folder writable?");
  });
}

VtkSeries::VtkSeries(std::filesystem::path folder, std::string name)
    : folder_(std::move(folder)), name_(std::move(name)) {
  make_folder(folder_ / "vtk");
}

std::filesystem::path VtkSeries::file(std::size_t index) const {
  return std::filesystem::path("vtk") / fmt::format("{}_{:04}.vtp", name_, index);
}

void VtkSeries::add(double time, const Mesh& mesh) {
  assert(times_.empty() || time >= times_.back());
  // A stage starts where the last one ended, with arrays of its own: its frame takes the place of the other's.
  if (!times_.empty() && time == times_.back()) times_.pop_back();
  write_vtp(folder_ / file(times_.size()), mesh, time);
  times_.push_back(time);
}

std::filesystem::path VtkSeries::finish() {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n  "
      "<Collection>\n";
  for (std::size_t k = 0; k < times_.size(); ++k)
    text += fmt::format("    <DataSet timestep=\"{:.17g}\" part=\"0\" file=\"{}\"/>\n", times_[k],
                        file(k).generic_string());
  text += "  </Collection>\n</VTKFile>\n";
  const std::filesystem::path path = folder_ / (name_ + ".pvd");
  write_text_file(path, text);
  std::error_code ignored;
  for (std::size_t k = times_.size(); std::filesystem::remove(folder_ / file(k), ignored); ++k) {
  }
  return path;
}

}  // namespace lamella
