#include "pipelines/cohesive_zone/split_beam.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "generator/sample/sample_file.h"
#include "pipelines/studies/facing_chains.h"
#include "postproc/output_file.h"

namespace lamella {

double SplitBeam::way(double force, double crack) {
  const double a3 = crack * crack * crack, l3 = kLength * kLength * kLength;
  return force * (a3 / (6 * kArm) + (l3 - a3) / (3 * kBonded));
}

// The way at which a crack of length a stands grows with a where it is stable, from 0.58 L on.
double SplitBeam::force_at(double asked, double toughness) {
  const auto standing = [&](double crack) { return std::sqrt(toughness / release(1, crack)); };
  double low = 0.58 * kLength, high = kLength;
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    (way(standing(middle), middle) < asked ? low : high) = middle;
  }
  return standing(low);
}

SplitCrack slide_crack(StudyBench& bench, int segments, double zone, double toughness) {
  using B = SplitBeam;
  const double spacing = B::kLength / segments;
  const FacingChains chains{.segments = segments,
                            .first_link = static_cast<int>(std::lround(B::kCrack / spacing)),
                            .spacing = spacing,
                            .radius = B::kThickness / 2};
  const Sample sample = make_facing_chains(chains);
  const std::string name = fmt::format("split_{}", segments);
  make_folder(bench.out() / "samples");
  write_sample(bench.out() / "samples" / (name + ".h5"), sample);
  // Slip d'' = (2 / EA + h^2 / 2 EI) f under the strength all along the zone, up to 2 G / f.
  const double yielding = 2 / B::kAxial + B::kThickness * B::kThickness / (2 * B::kArm);
  const double strength = std::sqrt(4 * toughness / yielding) / zone;
  const double stiffness = 10 * strength * strength / (2 * toughness);  // softens from a tenth of the last slip on
  const double last = B::way(std::sqrt(toughness / B::release(1, 85)), 85);
  std::vector<Index> held;
  for (const int k : {segments - 1, segments})
    held.push_back(upper_node(chains, k)), held.push_back(lower_node(chains, k));
  std::vector<std::string> settings{
      fmt::format("links.tangential_strength={}", strength),
      fmt::format("links.normal_strength={}", strength),
      fmt::format("links.tangential_stiffness={}", stiffness),
      fmt::format("links.normal_stiffness={}", stiffness),
      fmt::format("links.shear_toughness={}", toughness),
      fmt::format("links.toughness={}", toughness),
      fmt::format("loads.push_upper.velocity_y={}", last),
      fmt::format("loads.push_lower.velocity_y={}", last),
      fmt::format("loads.hold.nodes={{ nodes = [{}, {}, {}, {}] }}", held[0], held[1], held[2], held[3])};
  const Scene scene = bench.scene("split.toml", settings);
  const StudyRun run = bench.run(name, sample, scene);
  const auto time = run.column("time"), upper = run.column("force_y_push_upper"),
             lower = run.column("force_y_push_lower"), broken = run.column("broken_links");
  SplitCrack out;
  out.lowest = 1e9, out.seconds = run.facts.seconds;
  // A section of both beams as one, ahead of the zone and away from what holds the end.
  const int section = static_cast<int>(std::lround(0.95 * segments)) - 1;
  int count = 0;
  std::size_t row = 0;  // the last one of the frame's time
  for (int f = 0; f < run.reader.frames(); ++f) {
    const double now = run.reader.frame(f).time;
    while (row + 1 < time.size() && time[row + 1] <= now * (1 + 1e-9)) ++row;
    const auto x = run.positions(f);
    const auto turn = [&](int from_left) {
      const Vec2 a = x[upper_node(chains, from_left + 1)] - x[upper_node(chains, from_left)];
      const Vec2 b = x[lower_node(chains, from_left + 1)] - x[lower_node(chains, from_left)];
      return 0.5 * (std::atan2(-a.y(), a.x()) + std::atan2(-b.y(), b.x()));
    };
    const double force = upper[row] + lower[row], moment = force * (section + 0.5) * spacing;
    out.way.push_back(last * now), out.force.push_back(force);
    out.ratio.push_back((force * (turn(0) - turn(section)) - moment * moment / (2 * B::kBonded)) / toughness);
    if (broken[row] < 2) continue;
    const double exact = B::force_at(out.way.back(), toughness);
    ++count, out.mean += out.ratio.back(), out.force_error += std::abs(force / exact - 1);
    out.lowest = std::min(out.lowest, out.ratio.back()), out.highest = std::max(out.highest, out.ratio.back());
  }
  out.mean /= std::max(1, count), out.force_error /= std::max(1, count);
  out.broken = static_cast<int>(run.reader.events().size());
  for (const Event& event : run.reader.events()) out.mode_mix += event.mode_mix / out.broken;
  return out;
}

}  // namespace lamella
