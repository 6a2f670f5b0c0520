#include "generator/packing/variation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "generator/packing/domain.h"
#include "generator/sample/errors.h"

namespace lamella {
namespace {

double position(const std::string& along, const Box& box, const Vec2& p) {
  if (along == "x") return p.x();
  if (along == "y") return p.y();
  return (p - (box.lo + box.hi) / 2).norm();
}

/// Linear between the pairs, constant beyond.
double interpolate(const std::vector<Vec2>& pairs, double at) {
  const auto after =
      std::upper_bound(pairs.begin(), pairs.end(), at, [](double value, const Vec2& pair) { return value < pair.x(); });
  if (after == pairs.begin()) return pairs.front().y();
  if (after == pairs.end()) return pairs.back().y();
  const Vec2 &a = *(after - 1), &b = *after;
  const double share = (at - a.x()) / (b.x() - a.x());
  return (1 - share) * a.y() + share * b.y();
}

void refuse_bad_pairs(const std::vector<Vec2>& pairs, const std::string& key) {
  std::vector<std::string> faults;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    if (!pairs[k].allFinite() || !(pairs[k].y() > 0))
      faults.push_back(
          fmt::format("sample.gradient.{}: entry {} is [{:g}, {:g}]; the factor must be positive and both "
                      "numbers finite",
                      key, k, pairs[k].x(), pairs[k].y()));
    if (k > 0 && !(pairs[k].x() > pairs[k - 1].x()))
      faults.push_back(
          fmt::format("sample.gradient.{}: entry {} at {:g} m does not lie beyond the one before, at {:g} m; "
                      "positions must increase",
                      key, k, pairs[k].x(), pairs[k - 1].x()));
  }
  if (!faults.empty()) throw SceneError(std::move(faults));
}

bool holds(const LayerScene& layer, const Box& box, const Vec2& p) {
  if (!layer.polygon.empty()) return Domain{{layer.polygon}, {}, {}, 0}.contains(p);
  const double at = position(layer.along, box, p);
  return layer.from <= at && at < layer.to;
}

}  // namespace

PositionFactor gradient_factor(const GradientScene& gradient, const std::vector<Vec2>& pairs, const std::string& key,
                               const Box& box) {
  refuse_bad_pairs(pairs, key);
  if (pairs.empty()) return {};
  return [along = gradient.along, pairs, box](const Vec2& p) { return interpolate(pairs, position(along, box, p)); };
}

int layer_at(const std::vector<LayerScene>& layers, const Box& box, const Vec2& point) {
  for (auto k = static_cast<int>(layers.size()); k-- > 0;)
    if (holds(layers[k], box, point)) return k;
  return -1;
}

PositionFactor size_factor(const SampleScene& scene, const Box& box) {
  PositionFactor of_gradient;
  if (scene.gradient) of_gradient = gradient_factor(*scene.gradient, scene.gradient->size, "size", box);
  const bool layered =
      std::any_of(scene.layers.begin(), scene.layers.end(), [](const LayerScene& layer) { return layer.size != 1; });
  if (!layered) return of_gradient;
  return [of_gradient, layers = scene.layers, box](const Vec2& p) {
    const int layer = layer_at(layers, box, p);
    return (of_gradient ? of_gradient(p) : 1) * (layer < 0 ? 1 : layers[layer].size);
  };
}

}  // namespace lamella
