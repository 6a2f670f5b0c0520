// Double cantilever beams: load and opening at the first break, energy released by it, and growth of the crack, against the exact solution of
// the discrete model. Linear fracture mechanics is its limit.
#include <fmt/format.h>

#include <cmath>

#include "generator/sample/sample_file.h"
#include "pipelines/double_cantilever/exact_beam.h"
#include "pipelines/studies/equilibrium.h"
#include "pipelines/studies/study.h"
#include "postproc/output_file.h"

namespace lamella {
namespace {

using Exact = ExactBeam;

Load at_node(Index node) {
  Load load;
  load.nodes = {node};
  return load;
}

/// Far ends held, unit forces that part the near ends.
std::vector<Load> pulling_loads(const FacingChains& chains) {
  std::vector<Load> loads{at_node(upper_node(chains, chains.segments)), at_node(lower_node(chains, chains.segments)),
                          at_node(upper_node(chains, 0)), at_node(lower_node(chains, 0))};
  for (int k : {0, 1}) loads[k].holds[0] = loads[k].holds[1] = true;
  for (int k : {2, 3}) loads[k].pushes = true, loads[k].force = {Vec2(0, k == 2 ? 1 : -1)};
  return loads;
}

Scene scene_of(const StudyBench& bench, double beta, double strength, const std::vector<std::string>& more = {}) {
  std::vector<std::string> settings{fmt::format("links.normal_stiffness={}", beta * beta / 2),
                                    fmt::format("links.tangential_stiffness={}", beta * beta / 2),
                                    fmt::format("links.normal_strength={}", strength),
                                    fmt::format("links.tangential_strength={}", strength)};
  settings.insert(settings.end(), more.begin(), more.end());
  return bench.scene("double_cantilever.toml", settings);
}

struct StaticBeam {
  double load = 0, half_opening = 0, released = 0;  // as Exact
};

/// The same by the model's own energies: equilibrium under a pull up to the first break, then at that opening with the link gone.
StaticBeam solve_beam(const StudyBench& bench, double beta, int crack, double strength) {
  const FacingChains chains = glued_beam(beta, crack);
  const Sample sample = make_facing_chains(chains);
  const Exact exact(beta, crack);
  const Scene scene = scene_of(bench, beta, strength);
  const Field rest = field_of(sample.x);
  const auto model = build_model(sample, scene.stages.front(), rest);
  const StaticBreak found = find_first_break(*model, pulling_loads(chains), rest, 0.9 * strength * exact.load());
  StaticBeam out;
  out.load = found.factor / strength;
  out.half_opening = (found.x.y[upper_node(chains, 0)] - rest.y[upper_node(chains, 0)]) / strength;

  FacingChains longer = chains;
  longer.first_link = crack + 1;
  const Sample cracked = make_facing_chains(longer);
  const auto after = build_model(cracked, scene.stages.front(), rest);
  std::vector<Load> holding = pulling_loads(chains);
  for (Load& load : holding) load.pushes = false, load.holds[1] = true;
  const Field x = find_equilibrium(*after, holding, 0, found.x).x;
  out.released = (model->energy(found.x) - after->energy(x)) / (strength * strength / (beta * beta));
  return out;
}

enum class Drag { kLight, kArresting };  // arresting: the break of a link does not shake the next one loose

/// How a run opens the beam: fast to just before the first break, then slowly, then not at all.
struct Course {
  double beta = 0.1;
  int crack = 20;
  double strength = 0;       // of a link [N]
  int spare = 0;             // as `glued_beam`
  double last = 1.002;       // half opening where the run ends, over that of the first break
  int frames = 20;           // of the slow part
  double slower = 1;         // speed before over speed during the slow part
  Drag drag = Drag::kLight;  // from the slow part on
  double before = 0.98;      // half opening where the slow part begins, over that of the first break
};

struct Opened {
  StudyRun run;
  std::vector<double> openings;                     // half opening at each break [m]
  std::vector<double> frame_openings, frame_loads;  // [m], [N]
  double load = 0;                                  // at the first break [N]
  double released = 0;                              // from the first break on: fracture, and what drag took [J]
};

Opened open_beam(StudyBench& bench, const std::string& name, const Course& course) {
  const Exact exact(course.beta, course.crack);
  FacingChains chains = glued_beam(course.beta, course.crack, course.spare);
  const Sample sample = make_facing_chains(chains);
  const std::filesystem::path samples = bench.out() / "samples";
  make_folder(samples);
  write_sample(samples / fmt::format("crack_{}_bonded_{}.h5", course.crack, chains.segments - course.crack), sample);

  // An arm that is clamped where the bonded part has decayed, and held at its end, swings with this frequency.
  const double omega = 15.4 / std::pow(course.crack + exact.decay(), 2);
  const double first = exact.half_opening() * course.strength;
  const double time = (bench.small() ? 30 : 60) * 2 * M_PI / omega, ramp = 0.2 * time;
  const double fast = course.before * first / (time - 0.5 * ramp), slow = fast / course.slower;
  const double creep = (course.last - course.before) * first / slow;
  const bool arrests = course.drag == Drag::kArresting;
  const double rest = arrests ? std::max(0.3 * time, 20 * course.beta / (omega * omega)) : 0.001 * time;
  std::vector<std::string> settings{
      fmt::format("drag.rate={}", 0.02 * omega),
      fmt::format("stages.creep.drag.rate={}", arrests ? 1.2 * course.beta : 0.02 * omega),
      fmt::format("stages.open.stop.time={}", time),
      fmt::format("stages.creep.stop.time={}", creep),
      fmt::format("stages.creep.output.frames={}", course.frames),
      fmt::format("stages.hold.stop.time={}", rest),
      fmt::format("run.step_fraction={}", course.beta < 1 ? 0.5 : 0.1)};
  for (const auto& [load, sign] : {std::pair("open_upper", 1), std::pair("open_lower", -1)}) {
    settings.push_back(fmt::format("loads.{}.velocity_y={}", load, sign * fast));
    settings.push_back(fmt::format("loads.{}.ramp={}", load, ramp));
    settings.push_back(fmt::format("stages.creep.loads.{}.velocity_y={}", load, sign * slow));
  }
  Opened out{bench.run(name, sample, scene_of(bench, course.beta, course.strength, settings)), {}, {}, {}, 0, 0};
  const auto& events = out.run.reader.events();
  if (events.empty()) return out;
  const auto opening = [&](double t) {
    return t < time ? fast * (t - 0.5 * ramp) : course.before * first + slow * (t - time);
  };
  for (const Event& e : events) out.openings.push_back(opening(e.time));
  for (int f = 0; f < out.run.reader.frames(); ++f) {
    out.frame_openings.push_back(out.run.positions(f)[upper_node(chains, 0)].y() - chains.radius);
    out.frame_loads.push_back(out.run.array("load_force", f)[2 * upper_node(chains, 0) + 1]);
  }
  // Load per opening in the last frames before the break.
  int frames = 0;
  for (std::size_t f = out.frame_loads.size() - 1; f > 0 && frames < 5; --f) {
    if (out.frame_openings[f] >= out.openings.front()) continue;
    out.load += out.openings.front() * out.frame_loads[f] / out.frame_openings[f];
    ++frames;
  }
  out.load /= frames;
  // Each stage has a ledger of its own.
  const auto clock = out.run.column("time"), stage = out.run.column("stage"), damping = out.run.column("damping"),
             fracture = out.run.column("fracture");
  double before = 0, end = 0;
  for (std::size_t k = 0; k < clock.size(); ++k) {
    const double taken = damping[k] + fracture[k];
    if (k > 0 && stage[k] != stage[k - 1]) out.released += end - before, before = end = 0;
    if (clock[k] < events.front().time) before = taken;
    end = taken;
  }
  out.released += end - before;
  return out;
}

/// The beam near its crack just before the first break, deflections magnified; links coloured by what they carry.
void draw_beam(StudyReport& report, const StudyRun& run) {
  int frame = 0;
  while (frame + 1 < run.reader.frames() && run.reader.frame(frame + 1).time < run.reader.events().front().time)
    ++frame;
  const Sample& sample = run.reader.sample();
  const auto x = run.positions(frame);
  const auto force = run.array("link_force", frame);
  const double magnified = 5, right = 45;
  double largest = 0;
  for (std::size_t l = 0; l < sample.links.size(); ++l) largest = std::max(largest, force[2 * l]);
  report.picture("beam",
                 fmt::format("The test just before its first break, deflections {:g} times enlarged. Links: grey to "
                             "red as they near their "
                             "strength, blue where pressed.",
                             magnified),
                 {560, 170}, [&](Canvas& canvas) {
                   const auto place = [&](const Vec2& p) {
                     return Vec2(20 + 520 * p.x() / right, 85 - 520 * magnified * p.y() / right);
                   };
                   const Colour slack{0.8, 0.81, 0.83};
                   for (std::size_t l = 0; l < sample.links.size(); ++l) {
                     const Link& link = sample.links[l];
                     if (x[link.a].x() > right) continue;
                     const double share = force[2 * l] / largest;
                     const Colour colour = share < 0 ? mix(slack, {0.15, 0.35, 0.8}, std::min(1.0, -20 * share))
                                                     : mix(slack, {0.75, 0.05, 0.1}, share);
                     canvas.line({place(x[link.a]), place(x[link.b])}, {colour, 2.2, {}});
                   }
                   for (Index c = 0; c < sample.cells(); ++c) {
                     std::vector<Vec2> chain;
                     for (Index i = sample.cell_begin[c]; i < sample.cell_begin[c + 1]; ++i)
                       if (x[i].x() <= right) chain.push_back(place(x[i]));
                     canvas.line(chain, {{0.1, 0.11, 0.14}, 1.6, {}});
                     for (const Vec2& at : chain) canvas.dot(at, 1.8, {0.1, 0.11, 0.14});
                   }
                 });
}

void statics(StudyBench& bench) {
  StudyReport& report = bench.report;
  report.section("First break: the exact solution of the discrete model");
  report.text(
      "Two hinge chains (k_b = l = 1) are linked from node c on and pulled apart at node 0, with beta^2 = 2 k_n "
      "l^2 / k_b. The first link breaks at P_c = f_n0 q / (beta (1 + c (p - 1))), p + i q = 1 + i beta / 2 + "
      "sqrt(i beta - beta^2 / 4); opening and energy follow from the same solution. These rows solve for "
      "equilibrium with the program's bars, hinges and links, at slopes of 1e-4.");
  double worst_opening = 0, worst_energy = 0;
  const std::vector<double> betas =
      bench.small() ? std::vector<double>{.01, 1} : std::vector<double>{.001, .01, .1, 1, 10};
  ReportTable fracture_mechanics{{"beta", "c", "P_c / f_n0", "sqrt(G_c s EI) / a", "of it"}, {}};
  for (const double beta : betas)
    for (const int crack : {5, 20, 80}) {
      if (bench.small() && crack == 80) continue;
      const Exact exact(beta, crack);
      const StaticBeam found = solve_beam(bench, beta, crack, strength_for(exact, crack, 1e-4));
      report.compare(fmt::format("beta = {:g}, c = {}: P_c / f_n0, static", beta, crack), found.load, exact.load(),
                     1e-6);
      worst_opening = std::max(worst_opening, std::abs(found.half_opening / exact.half_opening() - 1));
      worst_energy = std::max(worst_energy, std::abs(found.released / exact.released() - 1));
      fracture_mechanics.rows.push_back({fmt::format("{:g}", beta), fmt::format("{}", crack),
                                         fmt::format("{:.6g}", exact.load()),
                                         fmt::format("{:.6g}", exact.fracture_mechanics()),
                                         fmt::format("{:.4f}", exact.load() / exact.fracture_mechanics())});
    }
  report.at_most("half opening at the first break: largest relative error of these", worst_opening, 1e-6);
  report.at_most("energy released by it: largest relative error of these", worst_energy, 1e-6);
  report.text(
      "Linear fracture mechanics with G_c s = W_0 / l is the limit beta -> 0, c >> sqrt(2 / beta). It is far off "
      "elsewhere: short cracks are weaker because the bonded part gives way, and a lattice of stiff links is "
      "tougher than W_0 / l, by (q / (p - 1))^2 in long cracks.");
  report.table(std::move(fracture_mechanics));
}

/// beta, crack, load over that of linear fracture mechanics.
struct RunDot {
  double beta = 0;
  int crack = 0;
  double of_limit = 0;
};

std::vector<RunDot> first_breaks(StudyBench& bench) {
  StudyReport& report = bench.report;
  report.section("First break of runs");
  report.text(
      "The near ends are moved apart slowly; opening and load are those at which the run breaks its first link. "
      "Arms turn by 1 %, which adds 1e-4 or so. Then a test with larger deflections, beta = 0.1, c = 20, f_n0 = "
      "4e-4: there the half opening is 4.7 % of the crack and large deflections add 0.2 %.");
  struct Case {
    double beta;
    int crack;
  };
  const std::vector<Case> all =
      bench.small() ? std::vector<Case>{{1, 5}}
                    : std::vector<Case>{{.01, 5}, {.01, 20}, {.1, 5}, {.1, 20}, {.1, 80}, {1, 5}, {1, 20}, {10, 5}};
  std::vector<RunDot> dots;
  double worst_ledger = 0;
  for (const auto& [beta, crack] : all) {
    const Exact exact(beta, crack);
    const double strength = strength_for(exact, crack, 0.01);
    const Opened opened = open_beam(bench, fmt::format("break_{:g}_{}", beta, crack),
                                    {.beta = beta, .crack = crack, .strength = strength});
    if (opened.openings.empty()) {
      report.holds(fmt::format("beta = {:g}, c = {}: a link breaks", beta, crack), false, "none");
      continue;
    }
    report.compare(fmt::format("beta = {:g}, c = {}: P_c / f_n0", beta, crack), opened.load / strength, exact.load(),
                   3e-3);
    report.compare(fmt::format("beta = {:g}, c = {}: half opening over f_n0 at the first break", beta, crack),
                   opened.openings[0] / strength, exact.half_opening(), 1e-3);
    worst_ledger = std::max(worst_ledger, opened.run.ledger());
    dots.push_back({beta, crack, opened.load / strength / exact.fracture_mechanics()});
  }
  const Opened test = open_beam(bench, "test", {.strength = 4e-4});
  if (!test.openings.empty()) {
    report.compare("the test: P_c", test.load, 2.0413e-4, 5e-3);
    report.compare("the test: half opening at the first break", test.openings[0], .94656, 5e-3);
    const StaticBeam large = solve_beam(bench, .1, 20, 4e-4);
    report.compare("the test: P_c, by equilibrium with large deflections", test.load, large.load * 4e-4, 3e-3);
    report.compare("the test: half opening, by equilibrium with large deflections", test.openings[0],
                   large.half_opening * 4e-4, 1e-3);
    dots.push_back({.1, 20, test.load / 4e-4 / Exact(.1, 20).fracture_mechanics()});
    worst_ledger = std::max(worst_ledger, test.run.ledger());
    draw_beam(report, test.run);
  }
  report.at_most("largest residual of the energy ledger", worst_ledger, 1e-3);
  return dots;
}

void draw_limit(StudyReport& report, const std::vector<RunDot>& dots) {
  Chart chart{.title = "Load at the first break over that of linear fracture mechanics",
              .x_label = "beta",
              .y_label = "P_c beta c / f_n0"};
  chart.x_scale = chart.y_scale = Scale::kLogarithmic;
  int colour = 0;
  for (const int crack : {5, 20, 80, 1000}) {
    std::vector<double> x, y, run_x, run_y;
    for (double beta = 1e-4; beta < 10.01; beta *= 1.1)
      x.push_back(beta), y.push_back(Exact(beta, crack).load() / Exact(beta, crack).fracture_mechanics());
    for (const RunDot& dot : dots)
      if (dot.crack == crack) run_x.push_back(dot.beta), run_y.push_back(dot.of_limit);
    chart.curves.push_back(line_curve(colour, fmt::format("c = {}", crack), x, y));
    if (!run_x.empty()) chart.curves.push_back(dotted_curve(colour, "", run_x, run_y));
    ++colour;
  }
  Curve limit = line_curve(4, "linear fracture mechanics", {1e-4, 10}, {1, 1});
  limit.style.width = 0.8, limit.style.dashes = {3, 3};
  chart.curves.push_back(limit);
  report.chart("limit",
               "Exact discrete solution (lines) and runs (dots). Only long cracks in weakly coupled chains are where "
               "linear fracture mechanics holds.",
               chart);
}

void energy(StudyBench& bench) {
  StudyReport& report = bench.report;
  report.section("What a break releases");
  report.text(
      "While the opening is held, the break of one link takes more out of the beam than the link's own W_0: with "
      "it goes what the arms could give and the next link cannot hold back. The rest is kinetic energy first, and "
      "heat after it: in runs, fracture and drag from the break until rest are added up. *Static* rows take the "
      "difference of two equilibria.");
  double worst_known = 0;
  struct Case {
    double beta;
    int crack;
    double known;  // to two or three decimals
  };
  for (const Case& one :
       {Case{.01, 10, 1.029}, {.01, 160, 1.132}, {.1, 10, 1.28}, {.1, 160, 1.54}, {1, 10, 3.34}, {1, 160, 4.25}}) {
    const Exact exact(one.beta, one.crack);
    const std::string what = fmt::format("beta = {:g}, c = {}: energy released over W_0", one.beta, one.crack);
    worst_known = std::max(worst_known, std::abs(exact.released() - one.known));
    if (!bench.small() || one.crack == 10)
      report.compare(what + ", static",
                     solve_beam(bench, one.beta, one.crack, strength_for(exact, one.crack, 1e-4)).released,
                     exact.released(), 1e-5);
    if (one.crack != 10 || (bench.small() && one.beta < 1)) continue;
    const double strength = strength_for(exact, one.crack, 0.005);
    const Opened opened =
        open_beam(bench, fmt::format("released_{:g}_{}", one.beta, one.crack),
                  {.beta = one.beta, .crack = one.crack, .strength = strength, .slower = 30, .drag = Drag::kArresting});
    report.compare(what, opened.released / (strength * strength / (one.beta * one.beta)), exact.released(), 1e-2);
    report.compare(fmt::format("beta = {:g}, c = {}: links that break", one.beta, one.crack),
                   static_cast<double>(opened.openings.size()), 1, 0);
  }
  report.at_most("closed form against known values of the energy released: largest difference", worst_known, 5e-3);
}

void growth(StudyBench& bench) {
  StudyReport& report = bench.report;
  report.section("Growth of the crack");
  report.text(
      "The beam with beta = 0.1 and c = 10 is opened on, so slowly and with so much drag that each break comes to "
      "rest before the next: then the k-th link breaks at the opening at which a crack of c + k - 1 begins to grow.");
  const double beta = 0.1;
  const int crack = 10;
  const double strength = strength_for(Exact(beta, crack), crack, 0.005);
  const Opened opened = open_beam(bench, "growth",
                                  {.beta = beta,
                                   .crack = crack,
                                   .strength = strength,
                                   .spare = 20,
                                   .last = bench.small() ? 1.6 : 4.0,
                                   .frames = bench.small() ? 20 : 100,
                                   .slower = 10,
                                   .drag = Drag::kArresting});
  double worst = 0;
  for (std::size_t k = 0; k < opened.openings.size(); ++k)
    worst = std::max(
        worst, std::abs(opened.openings[k] / strength / Exact(beta, crack + static_cast<int>(k)).half_opening() - 1));
  report.at_least("links that break", static_cast<double>(opened.openings.size()), bench.small() ? 3 : 8);
  report.at_most("openings at which they break: largest relative error", worst, 1e-2);
  Chart chart{.title = "Growth of the crack, beta = 0.1", .x_label = "half opening / f_n0", .y_label = "P / f_n0"};
  std::vector<double> x, y, exact_x, exact_y, limit_x, limit_y;
  for (std::size_t f = 0; f < opened.frame_loads.size(); ++f)
    x.push_back(opened.frame_openings[f] / strength), y.push_back(opened.frame_loads[f] / strength);
  for (int c = crack; c <= crack + static_cast<int>(opened.openings.size()); ++c) {
    const Exact exact(beta, c);
    exact_x.push_back(exact.half_opening()), exact_y.push_back(exact.load());
    limit_x.push_back(c * c / (3 * beta)), limit_y.push_back(exact.fracture_mechanics());  // w = P c^3 / 3 EI
  }
  chart.curves = {line_curve(0, "run", x, y),
                  dotted_curve(1, "exact: a crack of c = 10, 11, ... begins to grow", exact_x, exact_y)};
  Curve limit = line_curve(4, "linear fracture mechanics", limit_x, limit_y);
  limit.style.width = 0.8, limit.style.dashes = {3, 3};
  chart.curves.push_back(limit);
  report.chart("growth", "Load over opening of a beam that tears link by link.", chart);
  report.at_most("residual of the energy ledger", opened.run.ledger(), 1e-3);
}

}  // namespace

void study_double_cantilever(StudyBench& bench) {
  statics(bench);
  draw_limit(bench.report, first_breaks(bench));
  energy(bench);
  growth(bench);
}

}  // namespace lamella
