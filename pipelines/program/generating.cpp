#include "pipelines/program/generating.h"

#include <fmt/format.h>

#include <cstdint>
#include <map>
#include <optional>

#include "generator/sample/errors.h"
#include "generator/sample/h5.h"
#include "generator/sample/parallel.h"
#include "generator/sample/sample_file.h"
#include "generator/tissue/mosaic_file.h"
#include "pipelines/program/interrupt.h"
#include "pipelines/program/writable.h"
#include "pipelines/tissue/export.h"
#include "pipelines/tissue/tissue_report.h"
#include "postproc/output_file.h"
#include "simulator/trajectory/extract.h"
#include "simulator/trajectory/trajectory.h"

namespace lamella {
namespace {

namespace fs = std::filesystem;

bool is_picture(const fs::path& path) {
  return path.extension() == ".png" || path.extension() == ".svg" || path.extension() == ".pdf";
}

void require_export(const fs::path& path) {
  require_writable_file(path);
  if (!is_export_ending(path))
    throw DataError(fmt::format("{}: unknown format \"{}\"; must end in {}", path.string(), path.extension().string(),
                                kExportEndings));
}

/// Outlines are no tessellation: what lies between them belongs to no cell.
std::vector<fs::path> export_outlines(const fs::path& out, const Sample& sample) {
  if (is_picture(out)) {
    draw_sample(out, sample);
    return {out};
  }
  if (out.extension() == ".tess")
    throw DataError(fmt::format(
        "{}: the file holds no tiles, and outlines are no tessellation; export .off or .txt, or use lamella generate "
        "--export",
        out.string()));
  return write_cells(out, outlines_of(sample));
}

/// The site of every tile, where there is just one for each in the same order.
std::vector<Disk> seeds_of(const Origin& origin) {
  std::vector<Disk> seeds;
  if (origin.sites.empty()) return {};
  std::map<std::int64_t, std::size_t> place;
  for (std::size_t i = 0; i < origin.packing.number.size(); ++i) place[origin.packing.number[i]] = i;
  for (const MosaicCell& tile : origin.tiles.cells)
    seeds.push_back(origin.sites[place.empty() ? static_cast<std::size_t>(tile.number) : place.at(tile.number)]);
  return seeds;
}

void say_files(const std::vector<fs::path>& files, Progress& progress) {
  for (const fs::path& file : files) progress.say("  " + file.string());
}

Sample frame_or_sample(const fs::path& from, bool trajectory, int frame) {
  if (!trajectory) return read_sample(from);
  return extract_sample(TrajectoryReader(from), frame);
}

}  // namespace

Sample generate_sample(const Scene& scene, Progress& progress, Origin* origin, Notes* kept) {
  if (scene.sample.kind.empty())
    throw SceneError(
        fmt::format("{}: sample: missing; describe the geometry in [sample], or simulate a file with --sample",
                    scene.path.string()));
  Notes notes;
  progress.start("generate");
  Sample sample = generate(
      scene, notes,
      [&](double done, const std::string& what) {
        stop_if_interrupted();
        progress.show(done, what);
      },
      origin);
  progress.finish();
  for (const auto& note : notes) progress.say("  " + note);
  if (kept) *kept = notes;
  return sample;
}

void generate_command(const GenerateArguments& arguments, Verbosity verbosity) {
  const Scene scene = load_scene(arguments.scene);
  if (arguments.threads) use_threads(*arguments.threads);
  require_writable_file(arguments.out);
  for (const fs::path& path : arguments.exports) require_export(path);
  if (!arguments.report.empty()) require_writable_folder(arguments.report);
  Progress progress(verbosity);
  Origin origin;
  Notes notes;
  const Sample sample = generate_sample(scene, progress, &origin, &notes);
  make_folder(fs::absolute(arguments.out).parent_path());
  write_sample(arguments.out, sample, origin.tiles);
  progress.say(fmt::format("{}: {} cells, {} nodes, {} links", arguments.out.string(), sample.cells(), sample.nodes(),
                           sample.links.size()));
  for (const fs::path& path : arguments.exports) {
    make_folder(fs::absolute(path).parent_path());
    const bool tiles = !origin.tiles.cells.empty() && !is_picture(path);
    say_files(tiles ? write_cells(path, origin.tiles, seeds_of(origin)) : export_outlines(path, sample), progress);
  }
  if (arguments.report.empty()) return;
  make_folder(arguments.report);
  say_files(write_tissue_report(arguments.report, scene, sample, origin, notes), progress);
}

void export_command(const fs::path& from, const std::string& of, int frame, const fs::path& out, Verbosity verbosity) {
  require_export(out);
  Progress progress(verbosity);
  const h5::Node file = h5::Node::open(from);
  const bool trajectory = file.has_attribute("format") && file.text("format").starts_with("lamella trajectory");
  std::optional<Mosaic> tiles;
  if (of == "tiles" || (of.empty() && !is_picture(out))) {
    if (!trajectory) tiles = read_tiles(from);
    if (!tiles && of == "tiles")
      throw DataError(fmt::format("{}: holds no tiles; lamella generate keeps them of tissues, honeycombs and polygons",
                                  from.string()));
  }
  make_folder(fs::absolute(out).parent_path());
  say_files(tiles ? write_cells(out, *tiles) : export_outlines(out, frame_or_sample(from, trajectory, frame)),
            progress);
}

}  // namespace lamella
