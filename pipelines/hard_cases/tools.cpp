#include "pipelines/hard_cases/tools.h"

#include <fmt/format.h>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

#include "generator/sample/errors.h"
#include "postproc/drawing/tissue_drawing.h"
#include "simulator/assembly.h"
#include "simulator/steppers/stable_time_step.h"

namespace lamella::hard_cases {
namespace {

/// What of the strength of one link a force of this direction leaves: the factor by which it reaches the criterion
/// s f_n / f_n0 + (s f_t / f_t0)^2 = 1.
double factor_at_break(double n, double t) {
  const double root = std::sqrt(n * n + 4 * t * t);
  return n + root > 0 ? 2 / (n + root) : 1e300;
}

}  // namespace

Rig::Rig(const Sample& sample, const Stage& stage) : Rig(sample, stage, build_loads(sample, stage)) {}

Rig::Rig(const Sample& sample, const Stage& stage, std::vector<Load> with)
    : state{field_of(sample.x), Field(sample.nodes()), 0, 0},
      model(build_model(sample, stage, state.x)),
      loads(std::move(with)),
      stepper(*model, loads, state, 1) {}

double Rig::stored() const { return model->energy(state.x); }

Field Rig::force() const {
  Field f(state.x.size());
  for (const Term* term : model->terms()) term->add_force(state.x, f);
  return f;
}

double Rig::stable_step() const { return stable_time_step(*model, state.x, stepper.fully_held()).dt; }

Vec2 Rig::momentum() const {
  Vec2 sum = Vec2::Zero();
  for (std::size_t i = 0; i < state.x.size(); ++i) sum += model->mass[i] * state.v.at(i);
  return sum;
}

double Rig::angular_momentum() const {
  double sum = 0;
  for (std::size_t i = 0; i < state.x.size(); ++i) sum += model->mass[i] * cross(state.x.at(i), state.v.at(i));
  return sum;
}

Tension pull_statically(const Sample& sample, Stage stage) {
  stage.contact.reset();  // facing walls just touch: whether one does is rounding
  const Field x = field_of(sample.x);
  const auto model = build_model(sample, stage, x);
  const FreeComponents all(x.size(), {});
  const Eigen::SparseMatrix<double> k = assembled_stiffness(*model, all, x);

  // Held components are known: bottom 0, top a unit along y.
  Eigen::VectorXd u = Eigen::VectorXd::Zero(all.size()), top = u;
  double low = 0, high = 0, lows = 0, highs = 0;
  Load grips;
  grips.holds[0] = grips.holds[1] = true;
  for (Index i = 0; i < sample.nodes(); ++i) {
    if (sample.side[i] & kBottom) low += sample.x[i].y(), ++lows;
    if (sample.side[i] & kTop) high += sample.x[i].y(), ++highs, top[2 * i + 1] = 1;
    if (sample.side[i] & (kBottom | kTop)) grips.nodes.push_back(i);
  }
  const FreeComponents free(x.size(), {grips});
  const auto field_of_rows = [](const Eigen::VectorXd& rows) {
    return field_from(std::vector<double>(rows.data(), rows.data() + rows.size()));
  };
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(assembled_stiffness(*model, free, x));
  if (solver.info() != Eigen::Success) throw SolverError("the stiffness of the sample is singular");
  Field moved = field_of_rows(top);
  free.add(solver.solve(free.gathered(field_of_rows(-(k * top)))), 1, moved);
  u = all.gathered(moved);

  const double grip = top.dot(k * u);  // of the top, per unit of opening [N/m]
  const double length = high / highs - low / lows, width = sample.box.size().x() * stage.cell("cells").depth;
  Tension out;
  out.modulus = grip * length / width;

  const LinkScene& links = stage.links.at("links");
  if (!links.normal_strength) return out;
  const double f_n0 = *links.normal_strength, f_t0 = links.tangential_strength.value_or(f_n0);
  double factor = 1e300;  // opening at which the first link breaks [m]
  const auto at = [&](Index i) { return Vec2(u[2 * i], u[2 * i + 1]); };
  for (const Link& l : sample.links) {
    const Vec2 tau = (sample.x[l.a_next] - sample.x[l.a_prev]) - (sample.x[l.b_next] - sample.x[l.b_prev]);
    const Vec2 turned = (at(l.a_next) - at(l.a_prev)) - (at(l.b_next) - at(l.b_prev));
    const Vec2 t = tau.normalized(), m = right_of(t);
    const double turn = left_of(t).dot(turned) / tau.norm();
    const Vec2 d = at(l.b) - at(l.a);
    const double opening = d.dot(m) + l.offset_t * turn, slip = d.dot(t) - l.offset_n * turn;
    factor = std::min(
        factor, factor_at_break(links.normal_stiffness * opening / f_n0, links.tangential_stiffness * slip / f_t0));
  }
  out.first_break = factor * grip;
  return out;
}

void expect_stop(StudyBench& bench, const std::string& what, const StudyRun& run, const std::string& object) {
  const bool timed = run.error.rfind("t = ", 0) == 0, named = run.error.find(object) != std::string::npos;
  bench.report.holds(what + ": stops with time, object and reason", timed && named,
                     run.error.empty() ? "it did not stop" : run.error);
  const int last = run.reader.frames() - 1;
  bool good = last >= 0;
  double time = 0;
  if (good) {
    const Sample& sample = run.reader.sample();
    const auto x = run.positions();
    time = run.reader.frame(last).time;
    for (const Vec2& p : x) good = good && p.allFinite();
    good = good && shortest_segment(sample, x) >= 0.1;
    for (Index c = 0; c < sample.cells(); ++c)
      if (sample.closed[c]) good = good && area_of(sample, c, x) >= 0.02 * sample.rest_area[c];
  }
  bench.report.holds(what + ": the last frame is on disk, and good", good,
                     fmt::format("{} frames, the last at t = {:.6g}", last + 1, time));
}

double shortest_segment(const Sample& sample, const std::vector<Vec2>& x) {
  double least = 1e300;
  for (Index c = 0; c < sample.cells(); ++c)
    for (Index i = sample.cell_begin[c]; i < sample.cell_begin[c + 1]; ++i)
      if (sample.starts_segment(c, i))
        least = std::min(least, (x[sample.next(c, i)] - x[i]).norm() / sample.rest_length[i]);
  return least;
}

double area_of(const Sample& sample, Index cell, const std::vector<Vec2>& x) {
  return polygon_area(x.data() + sample.cell_begin[cell], sample.cell_size(cell));
}

bool crosses_itself(const Sample& sample, Index cell, const std::vector<Vec2>& x) {
  const auto apart = [&](const Vec2& a, const Vec2& b, const Vec2& p, const Vec2& q) {
    return cross(b - a, p - a) * cross(b - a, q - a) < 0;
  };
  const Index begin = sample.cell_begin[cell], end = sample.cell_begin[cell + 1];
  for (Index i = begin; i < end; ++i)
    for (Index j = i + 2; j < end; ++j) {
      const Index k = sample.next(cell, i), l = sample.next(cell, j);
      if (l != i && apart(x[i], x[k], x[j], x[l]) && apart(x[j], x[l], x[i], x[k])) return true;
    }
  return false;
}

Sample with_tiny_segments(const Sample& from, double length) {
  Sample out;
  std::vector<Index> at(from.nodes());
  for (Index c = 0; c < from.cells(); ++c) {
    std::vector<Vec2> points;
    std::vector<std::uint8_t> side;
    for (Index i = from.cell_begin[c]; i < from.cell_begin[c + 1]; ++i) {
      at[i] = out.nodes() + static_cast<Index>(points.size());
      points.push_back(from.x[i]), side.push_back(from.side[i]);
      if (i != from.cell_begin[c]) continue;
      points.push_back(from.x[i] + length * (from.x[from.next(c, i)] - from.x[i]).normalized());
      side.push_back(from.side[i] & from.side[from.next(c, i)]);
    }
    const Index begin = out.nodes();
    add_cell(out, points, true, from.radius[c], "cells");
    std::copy(side.begin(), side.end(), out.side.begin() + begin);
  }
  out.box = from.box, out.tile_area = from.tile_area, out.walls = from.walls, out.links = from.links;
  for (Link& l : out.links)
    for (Index* node : {&l.a, &l.b, &l.a_prev, &l.a_next, &l.b_prev, &l.b_next}) *node = at[*node];
  return out;
}

double slope_of(const std::vector<double>& x, const std::vector<double>& y, double low, double high) {
  double n = 0, mx = 0, my = 0, xx = 0, xy = 0;
  for (std::size_t k = 0; k < x.size(); ++k)
    if (x[k] >= low && x[k] <= high) n += 1, mx += x[k], my += y[k], xx += x[k] * x[k], xy += x[k] * y[k];
  return (xy - mx * my / n) / (xx - mx * mx / n);
}

Balance balance_of(const Field& x, const Field& f) {
  Vec2 net = Vec2::Zero();
  double torque = 0, scale = 0, lever = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    net += f.at(i);
    torque += cross(x.at(i), f.at(i));
    scale += f.at(i).norm();
    lever = std::max(lever, x.at(i).norm());
  }
  return {net.norm() / scale, std::abs(torque) / (scale * lever)};
}

void draw_panels(StudyBench& bench, const std::string& name, const std::string& caption, std::vector<Panel> panels,
                 const std::optional<Box>& shown) {
  std::vector<Frame> frames(panels.size());
  std::vector<FrameView> views;
  std::vector<const FrameView*> pointers;
  for (std::size_t k = 0; k < panels.size(); ++k) {
    std::vector<double> flat;
    for (const Vec2& p : panels[k].x) flat.push_back(p.x()), flat.push_back(p.y());
    frames[k].arrays.add({"x", "m", "node", 2, std::move(flat)});
  }
  views.reserve(panels.size());
  for (std::size_t k = 0; k < panels.size(); ++k) views.emplace_back(*panels[k].sample, frames[k]);
  for (const FrameView& view : views) pointers.push_back(&view);
  const Box world = shown ? *shown : drawn_extent(pointers, std::nullopt);
  const double width = panels.size() == 1 ? 420 : panels.size() == 2 ? 300 : 230, gap = 14, header = 22;
  const double height = std::min(width * world.size().y() / world.size().x(), 360.0);
  const Vec2 size(static_cast<double>(panels.size()) * (width + gap) + gap, header + height + gap);
  bench.report.picture(name, caption, size, [&](Canvas& canvas) {
    for (std::size_t k = 0; k < panels.size(); ++k) {
      const Vec2 corner(gap + static_cast<double>(k) * (width + gap), header);
      const Box area{corner, corner + Vec2(width, height)};
      canvas.text({corner.x() + 0.5 * width, 15}, panels[k].title, {.size = 10.5, .anchor = Anchor::kCentre});
      const PageMap map(world, area);
      canvas.clipped(area, [&] {
        draw_cells(
            canvas, map, views[k], panels[k].fill ? panels[k].fill : [](Index) {
              return Colour{0.86, 0.90, 0.94};
            });
      });
    }
  });
}

}  // namespace lamella::hard_cases
