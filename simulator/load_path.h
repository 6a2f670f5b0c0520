// Where loads are at a time, when nothing but the load itself takes time: what a test at rest goes through.
#pragma once
#include "generator/sample/scene.h"
#include "simulator/loads.h"

namespace lamella {

class LoadPath {
 public:
  LoadPath(const Stage& stage, const Gauge& gauge);

  /// Until the loading's strain is reached (and left again), or stop.time, whichever comes first; 0: neither is given [s].
  double duration() const { return duration_; }
  /// Engineering strain of the loading, tension and opening positive.
  double strain(double time) const;
  /// Way of the load's held components since the stage began [m].
  Vec2 way(const Load& load, double time) const;
  /// Of the load's full force.
  double force_factor(const Load& load, double time) const;

 private:
  const LoadingScene* loading_ = nullptr;
  Gauge gauge_;
  double duration_ = 0;  // [s]
  double turn_ = 0;      // when loading turns to unloading [s]
};

}  // namespace lamella
