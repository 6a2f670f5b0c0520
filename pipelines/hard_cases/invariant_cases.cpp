// What must hold in any configuration: internal forces sum to nothing and are gradients, rigid motions cost nothing, angles know their turns.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <Eigen/Geometry>

#include "pipelines/hard_cases/hard_cases.h"
#include "pipelines/hard_cases/tools.h"

namespace lamella::hard_cases {
namespace {

/// Every node moved by up to `amplitude` in each direction.
void shake(Field& x, double amplitude, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-amplitude, amplitude);
  for (std::size_t i = 0; i < x.size(); ++i) x.add(i, {uniform(random), uniform(random)});
}

/// Largest difference of the force and the fourth-order central difference of the energy, over the largest force.
double gradient_error(const Term& term, Field x, double h) {
  Field f(x.size());
  term.add_force(x, f);
  double worst = 0, largest = 0;
  for (std::size_t i = 0; i < x.size(); ++i)
    for (const bool along_x : {true, false}) {
      double& at = along_x ? x.x[i] : x.y[i];
      const double here = at, force = along_x ? f.x[i] : f.y[i];
      const auto energy = [&](double shift) {
        at = here + shift;
        const double e = term.energy(x);
        at = here;
        return e;
      };
      const double slope = (8 * (energy(h) - energy(-h)) - (energy(2 * h) - energy(-2 * h))) / (12 * h);
      worst = std::max(worst, std::abs(force + slope)), largest = std::max(largest, std::abs(force));
    }
  return worst / largest;
}

/// The tissue of the scene with fluid in its cells.
Scene full_tissue(const StudyBench& bench) {
  return bench.scene("tissue.toml", {"sample.packing.count=6", "sample.packing.fraction=0.6", "sample.width=2.6",
                                     "sample.height=2.6", "cells.core.modulus=3"});
}

/// Rings pressed into each other, whose contacts rub.
struct Pile {
  explicit Pile(const StudyBench& bench)
      : scene(bench.scene("ten_to_one_rings.toml", {"sample.packing.count=24", "sample.packing.fraction=0.75",
                                                    "sample.width=4", "sample.height=4", "sample.sizes.ratio=2",
                                                    "sample.sizes.share=0.5", "contact.friction=0.3"})),
        sample(pressed(sample_of(scene))),
        rig(sample, scene.stages[0]) {
    rig.model->contacts->commit(rig.state.x);
    shake(rig.state.x, 1e-3, 8);
    rig.model->contacts->commit(rig.state.x);
  }
  static Sample pressed(Sample s) {
    for (Vec2& p : s.x) p *= 0.97;
    return s;
  }
  Scene scene;
  Sample sample;
  Rig rig;
};

}  // namespace

void internal_forces(StudyBench& bench) {
  StudyReport& report = bench.report;
  report.section("Momentum of internal forces");
  report.text(
      "A tissue and a pile of rings in random configurations: sums of forces and torques, relative, and forces beside "
      "differences of the energy.");
  const Scene scene = full_tissue(bench);
  const Sample sample = sample_of(scene);
  Stage stage = scene.stages[0];
  stage.loading.reset(), stage.contact.reset();
  Rig tissue(sample, stage);
  shake(tissue.state.x, 5e-3, 5);
  Pile pile(bench);
  shake(pile.rig.state.x, 1e-3, 9);
  double force = 0, torque = 0;
  const auto look = [&](const Rig& rig, const Term* term, const std::string& name, double h) {
    Field f(rig.state.x.size());
    term->add_force(rig.state.x, f);
    const Balance b = balance_of(rig.state.x, f);
    force = std::max(force, b.force), torque = std::max(torque, b.torque);
    report.at_most("force of the " + name + " against differences of their energy, relative",
                   gradient_error(*term, rig.state.x, h), 1e-8);
  };
  for (const Term* term : tissue.model->terms()) look(tissue, term, term->name(), 3e-5);
  look(pile.rig, pile.rig.model->contacts.get(), "contacts with friction", 3e-6);
  report.at_most("largest |sum F| over sum |F|, over the terms", force, 1e-12);
  report.at_most("largest |sum x F| over sum |F| and the extent, over the terms", torque, 1e-12);
}

void rigid_motion(StudyBench& bench) {
  StudyReport& report = bench.report;
  report.section("Rigid motion");
  const Scene scene = full_tissue(bench);
  const Sample sample = sample_of(scene);
  Stage stage = scene.stages[0];
  stage.loading.reset();
  Rig rig(sample, stage);
  const auto turned = [](const Field& x) {
    Field out(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) out.set(i, left_of(x.at(i)) + Vec2(3, -2));
    return out;
  };
  const auto largest = [](const Field& f) {
    double most = 0;
    for (std::size_t i = 0; i < f.size(); ++i) most = std::max(most, f.at(i).norm());
    return most;
  };
  const double l = sample.links[0].spacing, k = scene.stages[0].links.at("links").normal_stiffness * l;
  rig.state.x = turned(field_of(sample.x));
  report.at_most("bonded tissue, free of stress, turned by 90 degrees: largest force over k l",
                 largest(rig.force()) / (k * l), 1e-10);

  stage.contact.reset();
  Rig bent(sample, stage);
  shake(bent.state.x, 5e-3, 6);
  const Field before = bent.force();
  bent.state.x = turned(bent.state.x);
  const Field after = bent.force();
  double off = 0;
  for (std::size_t i = 0; i < before.size(); ++i) off = std::max(off, (after.at(i) - left_of(before.at(i))).norm());
  report.at_most("strained and turned: forces turn with it, largest difference relative", off / largest(before), 1e-12);

  Pile pile(bench);
  Contacts& contacts = *pile.rig.model->contacts;
  const double stored = contacts.stored_in_friction(), dissipated = contacts.friction_dissipated();
  const Field start = pile.rig.state.x;
  for (int degree = 1; degree <= 90; ++degree) {
    const Eigen::Rotation2Dd turn(degree * std::numbers::pi / 180);
    for (std::size_t i = 0; i < start.size(); ++i) pile.rig.state.x.set(i, turn * start.at(i));
    contacts.commit(pile.rig.state.x);
  }
  report.compare("pile turned by 90 degrees: energy in its friction springs, over that before",
                 contacts.stored_in_friction() / stored, 1, 1e-9);
  report.at_most("and what friction dissipates on the way, over that energy",
                 (contacts.friction_dissipated() - dissipated) / stored, 1e-9);
}

void fold_over(StudyBench& bench) {
  StudyReport& report = bench.report;
  report.section("A hinge that folds over");
  report.text(
      "One of two segments is turned about their common node, three times round and back. The angle is followed in "
      "time: the moment grows on "
      "through +-pi. (Walls of\ncells cannot get there: they touch themselves first.)");
  Sample chain;
  add_cell(chain, {{-1, 0}, {0, 0}, {1, 0}}, false, 0.01, "cells");
  chain.box = {{-1, -1}, {1, 1}};
  Stage stage;
  stage.cells["cells"].axial_rigidity = 10, stage.cells["cells"].bending_rigidity = 1;
  stage.cells["cells"].mass_per_length = 1, stage.cells["cells"].radius = 0.01;
  Rig rig(chain, stage);
  Hinges& hinges = *rig.model->hinges;
  const double k_b = 1, turns = 3;
  const int steps = 720;
  std::vector<double> angles, moments;
  double last = 0, jump = 0, error = 0, force = 0, torque = 0;
  for (int n = 1; n <= 2 * steps; ++n) {
    const double angle = 2 * std::numbers::pi * turns * (n <= steps ? n : 2 * steps - n) / steps;
    rig.state.x.set(2, Vec2(std::cos(angle), std::sin(angle)));
    ArraySet frame;
    hinges.add_output(rig.state.x, frame);
    const double moment = frame.doubles("moment")[1];
    jump = std::max(jump, std::abs(moment - last) / (k_b * 2 * std::numbers::pi * turns / steps));
    error = std::max(error, std::abs(moment - k_b * angle));
    last = moment;
    Field f(3);
    hinges.add_force(rig.state.x, f);
    if (n < 2 * steps) {
      const Balance b = balance_of(rig.state.x, f);
      force = std::max(force, b.force), torque = std::max(torque, b.torque);
    }
    hinges.commit(rig.state.x);
    angles.push_back(angle / (2 * std::numbers::pi)), moments.push_back(moment);
  }
  report.at_most("largest |dM| over k_b |d theta|", jump, 1 + 1e-9);
  report.at_most("largest distance of M from k_b theta, over k_b", error, 1e-9);
  report.at_most("largest sum of forces, relative", force, 1e-12);
  report.at_most("largest sum of torques, relative", torque, 1e-12);
  report.at_most("energy when it is unwound", hinges.energy(rig.state.x), 1e-20);
  Chart chart{.title = "A hinge turned three times and back", .x_label = "turns", .y_label = "M / k_b [rad]"};
  chart.curves = {dotted_curve(0, "found", angles, moments),
                  line_curve(1, "k_b theta", {0, 3}, {0, 6 * std::numbers::pi})};
  report.chart("fold_over", "Moment over angle.", chart);
}

}  // namespace lamella::hard_cases
