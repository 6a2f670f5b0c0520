#include "pipelines/cohesive_zone/grown_crack.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "generator/sample/sample_file.h"
#include "pipelines/studies/facing_chains.h"
#include "postproc/output_file.h"

namespace lamella {

GrownCrack grow_crack(StudyBench& bench, const std::string& file, double zone, const std::vector<std::string>& more) {
  const FacingChains chains{.segments = 110, .first_link = 36, .radius = 0.1};
  const Sample sample = make_facing_chains(chains);
  make_folder(bench.out() / "samples");
  write_sample(bench.out() / "samples" / "beams.h5", sample);
  const double toughness = 4e-7, strength = std::sqrt(toughness) / (zone * zone);  // beams.toml
  const double stiffness =
      10 * strength * strength / (2 * toughness);  // begins to soften at a tenth of the last opening
  std::vector<std::string> settings{fmt::format("links.normal_strength={}", strength),
                                    fmt::format("links.tangential_strength={}", strength),
                                    fmt::format("links.normal_stiffness={}", stiffness),
                                    fmt::format("links.tangential_stiffness={}", 0.3 * stiffness)};
  settings.insert(settings.end(), more.begin(), more.end());
  const Scene scene = bench.scene(file, settings);
  const StudyRun run = bench.run(fmt::format("beams_{:g}", zone), sample, scene);
  const auto time = run.column("time"), upper = run.column("force_y_open_upper"),
             lower = run.column("force_y_open_lower"), broken = run.column("broken_links");
  GrownCrack out;
  out.lowest = 1e9, out.ledger = run.ledger(), out.seconds = run.facts.seconds;
  int count = 0;
  std::size_t row = 0;  // the last one of the frame's time
  for (int f = 0; f < run.reader.frames(); ++f) {
    const double now = run.reader.frame(f).time;
    while (row + 1 < time.size() && time[row + 1] <= now * (1 + 1e-9)) ++row;
    const auto x = run.positions(f);
    const Vec2 first = x[upper_node(chains, 1)] - x[upper_node(chains, 0)];
    const double ratio = (upper[row] - lower[row]) * std::atan2(-first.y(), first.x()) / toughness;
    out.time.push_back(time[row]), out.ratio.push_back(ratio);
    if (broken[row] < 2) continue;
    ++count, out.mean += ratio;
    out.lowest = std::min(out.lowest, ratio), out.highest = std::max(out.highest, ratio);
  }
  out.mean /= std::max(1, count);
  return out;
}

}  // namespace lamella
