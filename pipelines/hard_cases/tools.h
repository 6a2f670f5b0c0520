// What the hard cases share: a model that is stepped by hand, its static answer, what must hold where a run stops, pictures of samples.
#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "pipelines/studies/study.h"
#include "simulator/loads.h"
#include "simulator/model.h"
#include "simulator/steppers/velocity_verlet.h"

namespace lamella::hard_cases {

/// A model with its loads and stepper, at rest at time 0. Sample and stage must outlive it.
struct Rig {
  Rig(const Sample& sample, const Stage& stage);
  /// The same on loads of one's own.
  Rig(const Sample& sample, const Stage& stage, std::vector<Load> with);

  double stored() const;            // energy of all terms [J]
  Field force() const;              // sum of all terms [N]
  double stable_step() const;       // [s]
  Vec2 momentum() const;            // [kg m/s]
  double angular_momentum() const;  // about the origin, x(n) with v(n-1/2) [kg m2/s]

  State state;
  std::unique_ptr<Model> model;
  std::vector<Load> loads;
  VelocityVerlet stepper;
};

/// The small-strain answer of a bonded sample pulled along y between the nodes of its bottom and top sides, without contact, by one linear solve.
struct Tension {
  double modulus = 0;      // stress over strain [Pa]
  double first_break = 0;  // grip force at which the first link breaks [N]; 0: links do not break
};
Tension pull_statically(const Sample& sample, Stage stage);

/// The run has stopped by itself, saying when, where (`object`) and why, and the last frame that it left is a good one.
void expect_stop(StudyBench& bench, const std::string& what, const StudyRun& run, const std::string& object);

/// Shortest segment over its rest length.
double shortest_segment(const Sample& sample, const std::vector<Vec2>& x);
/// Area inside the centre line of a cell [m2].
double area_of(const Sample& sample, Index cell, const std::vector<Vec2>& x);
/// Whether two segments of the cell, not neighbours, cross.
bool crosses_itself(const Sample& sample, Index cell, const std::vector<Vec2>& x);

/// The same cells, all closed, each with one segment more: of `length` [m] behind its first node.
Sample with_tiny_segments(const Sample& from, double length);

/// Slope of y over x by least squares, of the points with low <= x <= high.
double slope_of(const std::vector<double>& x, const std::vector<double>& y, double low, double high);

/// Sums of forces and torques over the sum of magnitudes (and the sample's extent).
struct Balance {
  double force = 0, torque = 0;
};
Balance balance_of(const Field& x, const Field& f);

/// One picture of a sample among several side by side.
struct Panel {
  const Sample* sample = nullptr;
  std::vector<Vec2> x;
  std::string title;
  std::function<Colour(Index)> fill;  // of a cell; null: pale
};
/// `shown`: the part of the world that is drawn; nothing: all [m].
void draw_panels(StudyBench& bench, const std::string& name, const std::string& caption, std::vector<Panel> panels,
                 const std::optional<Box>& shown = {});

}  // namespace lamella::hard_cases
