// The stepper at rest for tests of it, without a scene file.
#pragma once
#include <cmath>
#include <memory>
#include <optional>

#include "simulator/steppers/quasi_static.h"

namespace lamella {

/// A model, its loads and the stepper at rest, for a time of 1.
struct StaticRig {
  StaticRig(const Sample& sample, const Stage& with, std::vector<Load> l, QuasiStaticSettings settings = {})
      : stage(with), model(build_model(sample, stage, field_of(sample.x))), loads(std::move(l)), path(timed(), {}) {
    if (settings.longest == 0) settings.longest = 0.01;
    stepper.emplace(*model, loads, path, field_of(sample.x), 0.0, settings);
    stepper->settle();
  }
  const Stage& timed() {
    stage.stop.time = 1;
    return stage;
  }
  double energy() const { return model->energy(stepper->x()); }
  /// What the work exceeds what it has become by, over it.
  double open() const {
    const StaticWorks w = stepper->works();
    return std::abs(w.loads - energy() - w.fracture - w.released) / w.loads;
  }
  /// Up to the end, or until it is over.
  void run() {
    while (stepper->time() < 1 && stepper->over().empty()) {
      stepper->load_towards(1, [] { return true; });
      if (stepper->critical()) stepper->fall([] { return true; });
    }
  }

  Stage stage;
  std::unique_ptr<Model> model;
  std::vector<Load> loads;
  LoadPath path;
  std::optional<QuasiStatic> stepper;
};

}  // namespace lamella
