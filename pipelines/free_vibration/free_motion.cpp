#include "pipelines/free_vibration/free_motion.h"

namespace lamella {

void state_velocities(Stage& stage, const std::vector<Vec2>& velocities) {
  stage.initial.clear();
  for (std::size_t i = 0; i < velocities.size(); ++i) {
    InitialScene initial;
    initial.nodes.nodes = {static_cast<int>(i)};
    initial.velocity_x = velocities[i].x();
    initial.velocity_y = velocities[i].y();
    stage.initial.push_back(initial);
  }
}

void state_velocities(Stage& stage, const Sample& sample, const std::function<Vec2(const Vec2& x)>& velocity) {
  std::vector<Vec2> velocities;
  for (const Vec2& x : sample.x) velocities.push_back(velocity(x));
  state_velocities(stage, velocities);
}

Motion motion_of(const Scene& scene, const StudyRun& run, int frame) {
  const auto x = run.positions(frame);
  const auto v = run.array("v", frame);
  const auto model = build_model(run.reader.sample(), scene.stages.back(), field_of(x));
  Motion sum;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double m = model->mass[i];
    const Vec2 p = m * Vec2(v[2 * i], v[2 * i + 1]);
    sum.mass += m;
    sum.momentum += p, sum.largest_momentum += p.norm();
    sum.angular_momentum += cross(x[i], p), sum.largest_angular_momentum += x[i].norm() * p.norm();
    sum.moment_of_inertia += m * x[i].squaredNorm();
  }
  return sum;
}

}  // namespace lamella
