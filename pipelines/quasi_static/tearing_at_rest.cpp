// Behind the first break: curves that drop or snap back, and links that soften.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "pipelines/cohesive_zone/grown_crack.h"
#include "pipelines/double_cantilever/exact_beam.h"
#include "pipelines/quasi_static/at_rest.h"

namespace lamella::at_rest {
namespace {

struct Torn {
  std::vector<double> way, load;
  double work = 0, fracture = 0, released = 0, stored = 0, seconds = 0, ledger = 0;
  std::size_t breaks = 0;
  double back = 0;  // largest step back, over the way
  double peak = 0;

  Torn(const StudyRun& run, const std::string& along, const std::string& across)
      : way(run.column(along)),
        load(run.column(across)),
        work(run.last("work")),
        fracture(run.last("fracture")),
        released(run.last("released")),
        seconds(run.facts.seconds),
        ledger(run.ledger()),
        breaks(run.reader.events().size()) {
    for (const char* term : {"energy_bars", "energy_hinges", "energy_links"}) stored += run.last(term);
    for (std::size_t k = 1; k < way.size(); ++k) back = std::max(back, (way[k - 1] - way[k]) / way.back());
    peak = *std::max_element(load.begin(), load.end());
  }
};

void compare_both(StudyReport& report, const std::string& what, const Torn& falls, const Torn& follows,
                  ReportTable& table) {
  for (const Torn* t : {&falls, &follows})
    table.rows.push_back(
        {what + (t == &falls ? ", fall" : ", follow"), fmt::format("{}", t->breaks), fmt::format("{:.4g}", t->peak),
         fmt::format("{:.4g}", t->work), fmt::format("{:.4g}", t->fracture), fmt::format("{:.4g}", t->released),
         fmt::format("{:.4g}", t->stored), fmt::format("{:.2g}", t->ledger), fmt::format("{:.2g}", t->seconds)});
  report.at_most(what + ", fall: largest step back", falls.back, 0);
  if (what == "tissue") report.at_least(what + ", follow: largest step back over the way", follows.back, 1e-4);
  report.compare(what + ": peak, fall over follow", falls.peak / follows.peak, 1, 1e-3);
}

}  // namespace

void snap_back(StudyBench& bench) {
  StudyReport& report = bench.report;
  report.section("Snap-back: fall, or follow");
  report.text(
      "Where a link breaks and others hold the load no longer, the load may stay (`unstable = \"fall\"`): the curve "
      "drops, "
      "and what is set free is booked as released; or it may go back to where the next link is at its criterion "
      "(`\"follow\"`): the curve snaps back. What is released is in the table. In a double cantilever (beta = 1, c = "
      "10) the next link "
      "holds after every break: the load drops, and both ways are the same. In the tissue of `tissue.toml` they are "
      "not.");
  ReportTable table{
      {"case", "breaks", "peak", "work", "fracture", "released", "stored at the end", "ledger", "seconds"}, {}};
  const double beta = 1;
  const int crack = 10;
  const ExactBeam exact(beta, crack);
  const double strength = strength_for(exact, crack, 0.005), opening = exact.half_opening() * strength;
  const auto open = [&](const std::string& unstable) {
    Scene scene = bench.scene(
        "../double_cantilever/double_cantilever.toml",
        {kStepper, fmt::format("run.unstable=\"{}\"", unstable), "output.frames=10", "run.load_steps=200",
         "links.normal_stiffness=0.5", "links.tangential_stiffness=0.5",
         fmt::format("links.normal_strength={}", strength), fmt::format("links.tangential_strength={}", strength),
         "loads.open_upper.ramp=0", "loads.open_lower.ramp=0", fmt::format("loads.open_upper.velocity_y={}", opening),
         fmt::format("loads.open_lower.velocity_y={}", -opening),
         fmt::format("stages.open.stop.time={}", bench.small() ? 3.0 : 4.0)});
    scene.stages.resize(1);
    return Torn(bench.run("growth_" + unstable, make_facing_chains(glued_beam(beta, crack, 20)), scene),
                "moved_y_open_upper", "force_y_open_upper");
  };
  const Torn falls = open("fall"), follows = open("follow");
  compare_both(report, "double cantilever", falls, follows, table);
  report.at_most("double cantilever: residual of the ledger", std::max(falls.ledger, follows.ledger), 1e-2);
  const auto both = [&](const std::string& title, const std::string& x, const std::string& y, const Torn& a,
                        const Torn& b) {
    Chart chart{.title = title, .x_label = x, .y_label = y};
    chart.curves = {line_curve(3, "follow", b.way, b.load), line_curve(0, "fall", a.way, a.load)};
    chart.curves[0].style.width = 0.9;
    return chart;
  };
  report.chart("snap_back_beam", "A double cantilever opened on: each break drops the load, and the next link holds.",
               both("Double cantilever", "half opening", "P", falls, follows));

  const auto tear = [&](const std::string& unstable) {
    std::vector<std::string> settings{fmt::format("run.unstable=\"{}\"", unstable), "links.normal_stiffness=100",
                                      "links.tangential_stiffness=30"};
    if (bench.small()) settings.insert(settings.end(), {"sample.walls.segments=3"});
    return Torn(bench.run("tissue_" + unstable, "tissue.toml", settings), "strain", "stress");
  };
  const Torn tissue_falls = tear("fall"), tissue_follows = tear("follow");
  compare_both(report, "tissue", tissue_falls, tissue_follows, table);
  report.table(table);
  report.chart("snap_back_tissue", "A tissue torn in two: the area under each curve is its work of fracture.",
               both("Tissue", "strain", "stress", tissue_falls, tissue_follows));
}

void softening(StudyBench& bench) {
  StudyReport& report = bench.report;
  report.section("A crack between beams through links that soften");
  report.text(
      "`cohesive_zone/beams.toml` at rest: J s = 2 P theta of the arms' ends must be the toughness while the crack "
      "grows, which is linear fracture mechanics: P = sqrt(G s EI) / a in slender arms.");
  Chart chart{.title = "Contour integral while a crack grows, at rest", .x_label = "time", .y_label = "J / G"};
  ReportTable table{{"links soften over, spacings", "mean of J / G", "lowest", "highest", "seconds"}, {}};
  int colour = 0;
  for (const double zone : bench.small() ? std::vector<double>{5} : std::vector<double>{2, 3, 5, 8}) {
    const GrownCrack grown = grow_crack(bench, "../cohesive_zone/beams.toml", zone, {kStepper, "run.residual=1e-5"});
    report.compare(fmt::format("over {:g} spacings: mean of J / G", zone), grown.mean, 1, 2e-2);
    table.rows.push_back({fmt::format("{:g}", zone), fmt::format("{:.4f}", grown.mean),
                          fmt::format("{:.3f}", grown.lowest), fmt::format("{:.3f}", grown.highest),
                          fmt::format("{:.2g}", grown.seconds)});
    chart.curves.push_back(line_curve(colour++, fmt::format("{:g} spacings", zone), grown.time, grown.ratio));
  }
  report.table(table);
  report.chart("contour_integral", "J rises to the toughness, and stays there while the crack grows.", chart);
}

}  // namespace lamella::at_rest
