#include "postproc/summarise.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "postproc/quantities/cell_shape.h"
#include "postproc/quantities/fragments.h"

namespace lamella {
namespace {

constexpr std::size_t kFirstBreaks = 10;

double mean_cell_size(const Sample& sample) {
  double sum = 0;
  int count = 0;
  for (Index c = 0; c < sample.cells(); ++c)
    if (sample.closed[c]) sum += std::sqrt(4 * sample.rest_area[c] / M_PI), ++count;
  return count ? sum / count : 0;
}

/// Where a break happened, on the sample at rest.
Vec2 rest_place(const Sample& sample, const Event& event) {
  if (event.bar < 0) {
    const Link& link = sample.links.at(event.link);
    return 0.5 * (sample.x[link.a] + sample.x[link.b] + link_displacement(sample, event.link));
  }
  Index c = 0;
  while (event.bar >= sample.cell_begin[c + 1]) ++c;
  return 0.5 * (sample.x[event.bar] + sample.x[sample.next(c, event.bar)]);
}

void add_test(Summary& summary, const SummaryInputs& facts) {
  const MaterialConstants& m = facts.constants;
  const TestSetup& setup = *facts.setup;
  const bool shear = setup.kind == "shear";
  const Sample& sample = facts.last->sample;
  const std::string sides =
      facts.last->box_moves()
          ? "the sample repeats both ways, and its box is pulled: the strain across is that of the box, 0 where it is "
            "held"
      : sample.periodic[1 - setup.axis]
          ? "the sample repeats across the axis, where its length is held: with the strain across at 0"
          : "the sample's sides are free, the grips hold theirs";
  const std::string sign = setup.kind == "compression" ? " Compression counts positive here." : "";
  if (m.modulus)
    summary.add("test",
                {shear ? "shear_modulus" : "young_modulus", *m.modulus, "Pa",
                 fmt::format("slope of the least-squares line of nominal stress over engineering strain, from the "
                             "first row to the last before the stress passes 30 % of its peak or a link breaks (strain "
                             "{:.4g}); {}",
                             m.elastic_strain, sides)});
  if (m.modulus)
    summary.add("test", {"modulus_r_squared", m.modulus_r_squared, "1", "coefficient of determination of that line"});
  if (m.poisson)
    summary.add("test",
                {"poisson_ratio", *m.poisson, "1",
                 "minus the slope of mean lateral over axial strain in the frames of the elastic part (at least three, "
                 "else those before peak and first break); lateral strain is that of the cells' centroids in the "
                 "middle half of the gauge length, by a straight line; of a box that is pulled, that of its length "
                 "across"});
  summary.add("test", {"peak_stress", m.peak_stress, "Pa",
                       "largest nominal stress: force of grip b over box width times depth at rest." + sign});
  summary.add("test", {"strain_at_peak", m.strain_at_peak, "1",
                       "engineering strain of the gauge length at that stress." + sign});
  if (m.strain_at_failure)
    summary.add(
        "test",
        {"strain_at_failure", *m.strain_at_failure, "1",
         "first strain after the peak at which the stress is below 20 % of it, or at which the sample is in two"});
  summary.add("test", {"work_of_fracture_per_area", m.work_per_area, "J/m2",
                       std::string("integral of nominal stress over strain, times the gauge length, up to ") +
                           (m.strain_at_failure ? "failure" : "the end (the sample has not failed)") +
                           ": work of the grips over box width times depth"});
  summary.add("test", {"gauge_length", setup.gauge_length, "m", "distance of the gripped centre lines at rest"});
  summary.add("test", {"width", setup.width, "m", "of the box across the load"});
  summary.add("test", {"depth", setup.depth, "m", "out of the plane"});

  // The frame that carries most: there the mean over the cells can be compared with the grips.
  const auto component = [&](const Stress& s) { return setup.sign() * (shear ? s.xy : setup.axis == 0 ? s.xx : s.yy); };
  const auto most =
      std::max_element(facts.cell_stress.begin(), facts.cell_stress.end(),
                       [&](const auto& p, const auto& q) { return component(p.second) < component(q.second); });
  if (most != facts.cell_stress.end()) {
    summary.add(
        "accuracy",
        {"mean_cell_stress", component(most->second), "Pa",
         fmt::format("stress of the cells, mean weighted by tile area, in the frame at t = {:.6g} s where it is "
                     "largest; at rest it equals the grips'",
                     most->first)});
    summary.add("accuracy",
                {"grip_stress_then", value_at_frame(facts.curve.time, facts.curve.stress, most->first), "Pa",
                 "nominal stress at that time; it refers to the width at rest, the cells' to their present areas"});
  }
  const std::vector<double> a = response_column(facts.reader->response(), "force_a"),
                            b = response_column(facts.reader->response(), "force_b");
  double difference = 0, largest = 0;
  for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k)
    difference = std::max(difference, std::abs(a[k] - b[k])), largest = std::max(largest, std::abs(b[k]));
  if (largest > 0)
    summary.add("accuracy",
                {"grip_force_difference", difference / largest, "1",
                 "largest difference of the two grips' forces over the largest force: inertia of the sample"});
}

void add_fracture(Summary& summary, const SummaryInputs& facts) {
  const Sample& sample = facts.last->sample;
  const std::vector<Event>& events = facts.reader->events();
  if (const BrokenBars* bars = facts.last->broken_bars()) {
    summary.add("fracture",
                {"broken_bars", static_cast<double>(bars->count()), "1", "bars of walls broken in the last frame"});
    summary.add("fracture", {"opened_cells", static_cast<double>(bars->opened_cells(sample)), "1",
                             "cells that have lost a bar and are chains in the last frame"});
  }
  Index broken = 0;
  double broken_length = 0;
  for (std::size_t l = 0; l < sample.links.size(); ++l)
    if (!facts.last->intact(static_cast<Index>(l))) ++broken, broken_length += sample.links[l].length;
  summary.add("fracture", {"broken_links", static_cast<double>(broken), "1", "links broken in the last frame"});
  summary.add("fracture", {"broken_length", broken_length, "m", "sum of the tributary lengths of the broken links"});
  const Fragments pieces = fragments(*facts.last);
  summary.add("fracture", {"fragments", static_cast<double>(pieces.count), "1",
                           facts.last->broken_bars()
                               ? "components of shells, and of the pieces of opened cells, joined by intact links, "
                                 "last frame"
                               : "components of cells joined by intact links, last frame"});
  summary.add("fracture", {"cracks", static_cast<double>(facts.cracks.size()), "1",
                           "connected pieces of broken links, last frame"});
  if (facts.setup) {
    summary.add(
        "fracture",
        {"through_cracks", static_cast<double>(through_cracks(*facts.last, pieces, facts.setup->axis)), "1",
         "cracks across the tissue: 0 while a path of shells and intact links joins the grips, else 1 and "
         "one more for each fragment between them that reaches from one free side to the other; where the box is "
         "pulled, "
         "once nothing goes round it along the pull, as many as fragments go round it across, and at least one"});
  }
  const double size = mean_cell_size(sample);
  if (!facts.cracks.empty() && size > 0) {
    const Crack& main = facts.cracks.front();
    const CrackLine& line = main.lines.front();
    summary.add("fracture", {"longest_crack_length", main.length, "m",
                             "sum of the tributary lengths of its links, branches included"});
    summary.add("fracture", {"crack_opening", line.opening, "m",
                             "of its main line: normal distance beyond rest, mean over its length, last frame"});
    summary.add("fracture", {"path_roughness", roughness(line), "m",
                             "root mean square distance of its main line, at rest, from its best straight line"});
    summary.add("fracture", {"path_roughness_in_cells", roughness(line) / size, "1",
                             "the same over the mean cell diameter (of equal area)"});
    summary.add("fracture", {"path_tortuosity", tortuosity(line), "1",
                             "length of its main line over the distance of its ends, at rest"});
    summary.add("fracture",
                {"first_break_time",
                 std::min_element(facts.cracks.begin(), facts.cracks.end(),
                                  [](const Crack& p, const Crack& q) { return p.first_time < q.first_time; })
                     ->first_time,
                 "s", "time at which the first link broke"});
  }
  if (!events.empty() && size > 0) {
    summary.add("fracture", {"strain_at_first_break", events.front().strain, "1",
                             "nominal strain when the first link or bar broke"});
    double distance = 0;
    const std::size_t count = std::min(kFirstBreaks, events.size());
    for (std::size_t k = 0; k < count; ++k) {
      const Vec2 at = rest_place(sample, events[k]);
      double nearest = sample.box.size().maxCoeff();
      for (int axis = 0; axis < 2; ++axis)
        if (!sample.periodic[axis])
          nearest = std::min({nearest, at[axis] - sample.box.lo[axis], sample.box.hi[axis] - at[axis]});
      distance += nearest / static_cast<double>(count);
    }
    if (!(sample.periodic[0] && sample.periodic[1]))
      summary.add("fracture",
                  {"first_breaks_to_boundary_in_cells", distance / size, "1",
                   fmt::format("mean distance of the first {} breaks from the nearest side of the box, at rest, over "
                               "the mean cell diameter",
                               count)});
    double shear = 0, energy = 0, links = 0;
    for (const Event& e : events) {
      links += e.bar < 0 ? 1 : 0;
      shear += e.bar < 0 && e.mode_mix > M_PI / 4 ? 1 : 0, energy += e.energy;
    }
    if (links > 0)
      summary.add("fracture",
                  {"share_broken_in_shear", shear / links, "1", "share of broken links with mode mix above pi/4"});
    summary.add("fracture", {"fracture_energy", energy, "J",
                             "sum of the energies released by the breaks, what damage took before them included"});
  }
  if (facts.aspects.size() > 1) {
    // The frame closest to failure, or the last one; a cell relaxes once the crack has passed.
    const double time = facts.constants.time_at_peak;
    const auto nearest = std::min_element(
        facts.aspects.begin(), facts.aspects.end(),
        [&](const auto& p, const auto& q) { return std::abs(p.first - time) < std::abs(q.first - time); });
    const auto& last = facts.aspects.back();
    if (facts.setup)
      summary.add(
          "fracture",
          {"cell_elongation_at_peak", nearest->second / facts.aspects.front().second, "1",
           "mean aspect of the cells (from second moments of area) at peak stress over that of the first frame"});
    summary.add("fracture", {"cell_elongation_at_end", last.second / facts.aspects.front().second, "1",
                             "the same in the last frame: what stays"});
  }
}

void add_accuracy(Summary& summary, const SummaryInputs& facts) {
  const EnergyBudget& budget = facts.budget;
  if (budget.time.empty()) return;
  summary.add("accuracy", {"ledger_residual", budget.residual, "1",
                           "largest over the rows of |work - stored - kinetic - damping - friction - plastic - "
                           "fracture - released| over the "
                           "largest work so far"});
  if (facts.reader->provenance().contains("solver_cost")) {
    double left = 0;
    for (const double unbalanced : response_column(facts.reader->response(), "unbalanced"))
      left = std::max(left, unbalanced);
    summary.add("accuracy", {"largest_residual", left, "1",
                             "largest force that an equilibrium has left, over the largest internal force then"});
  }
  for (const EnergyBudget::Entry& sink : budget.sinks)
    if (sink.name == "released")
      summary.add("accuracy", {"released", sink.value.back(), "J",
                               "set free where the sample fell to its next equilibrium, with breaks and without"});
  summary.add("accuracy", {"largest_work", budget.largest_work, "J", "largest work done on the sample"});
  double kinetic = 0, stored = 0;
  const double until = facts.setup ? facts.constants.time_at_peak : budget.time.back();
  for (const EnergyBudget::Entry& sink : budget.sinks)
    if (sink.name == "kinetic")
      for (std::size_t k = 0; k < budget.time.size(); ++k)
        if (budget.time[k] <= until)
          kinetic = std::max(kinetic, sink.value[k]), stored = std::max(stored, budget.stored[k]);
  if (stored > 0)
    summary.add(
        "accuracy",
        {"kinetic_over_elastic", kinetic / stored, "1",
         facts.setup
             ? "largest kinetic over largest stored energy, up to peak stress: small when the test is quasi-static"
             : "largest kinetic over largest stored energy"});
}

}  // namespace

Summary summarise(const SummaryInputs& facts) {
  Summary summary;
  const Sample& sample = facts.last->sample;
  if (facts.setup && !facts.curve.strain.empty()) add_test(summary, facts);
  if ((!sample.links.empty() && facts.last->has("link_intact")) || facts.last->has("bar_broken"))
    add_fracture(summary, facts);
  add_accuracy(summary, facts);
  summary.add("sample", {"cells", static_cast<double>(sample.cells()), "1", "shells of the sample"});
  summary.add("sample", {"nodes", static_cast<double>(sample.nodes()), "1", "mass points"});
  summary.add("sample", {"walls", static_cast<double>(sample.walls.size()), "1", "contact lines of two cells"});
  summary.add("sample", {"links", static_cast<double>(sample.links.size()), "1", "cohesive links at rest"});
  if (const double size = mean_cell_size(sample); size > 0)
    summary.add("sample",
                {"mean_cell_diameter", size, "m", "of the circle of equal area, centre line, mean over cells"});
  summary.add("run", {"frames", static_cast<double>(facts.reader->frames()), "1", "frames of the trajectory"});
  summary.add("run", {"end_time", facts.last->frame.time, "s", "time of the last frame"});
  summary.add("run", {"steps", static_cast<double>(facts.last->frame.step), "1", "time steps up to the last frame"});

  if (facts.setup && !facts.constants.strain_at_failure && !facts.reader->events().empty())
    summary.warnings.push_back(
        "the stress has not fallen below 20 % of its peak: strain at failure is not defined, and the work of "
        "fracture counts up to the end only");
  if (facts.budget.residual > 1e-3)
    summary.warnings.push_back(
        fmt::format("the energy ledger is open by {:.2g} of the work (1e-3 is expected at the default step)",
                    facts.budget.residual));
  return summary;
}

}  // namespace lamella
