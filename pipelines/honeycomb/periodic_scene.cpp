#include "pipelines/honeycomb/periodic_scene.h"

#include <fmt/format.h>

#include "postproc/output_file.h"

namespace lamella {

Scene periodic_scene(const StudyBench& bench, const std::string& file, const std::string& name,
                     const std::vector<std::string>& settings, const UnitCell& cell, const Sample& sample,
                     const Eigen::Matrix2d& stress, double time, double ramp) {
  const Scene base = bench.scene(file, settings);
  const Eigen::VectorXd u = cell.displacement(cell.strain_of(stress)) / (time - 0.5 * ramp);
  std::string text = "# Run with";
  for (const std::string& setting : settings) text += " --set " + setting;
  text += "\n" + base.text;
  for (Index k = 0; k < sample.nodes(); ++k)
    if (k < sample.cell_begin[cell.centre()] || k >= sample.cell_begin[cell.centre() + 1])
      text += fmt::format(
          "[[loads]]\nname = \"n{0}\"\nnodes = {{ nodes = [{0}] }}\nvelocity_x = {1:.17g}\nvelocity_y = {2:.17g}\nramp "
          "= {3:.17g}\n",
          k, u[2 * k], u[2 * k + 1], ramp);
  const std::filesystem::path folder = bench.out() / "scenes";
  make_folder(folder);
  write_text_file(folder / (name + ".toml"), text);
  return read_scene(folder / (name + ".toml"), settings);
}

}  // namespace lamella
