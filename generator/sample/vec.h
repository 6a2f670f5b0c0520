// The plane: points, vectors and boxes. Everything that is small and dense is Eigen's.
#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>

namespace lamella {

using Vec2 = Eigen::Vector2d;

/// Axis-aligned rectangle [m].
struct Box {
  Vec2 lo = Vec2::Zero();
  Vec2 hi = Vec2::Zero();

  Vec2 size() const { return hi - lo; }
  double area() const { return (hi.x() - lo.x()) * (hi.y() - lo.y()); }
  bool contains(const Vec2& p) const { return (p.array() >= lo.array()).all() && (p.array() <= hi.array()).all(); }
};

/// In which directions, x and y, the plane repeats.
using Periodic = std::array<bool, 2>;

/// By how many lengths of a periodic box something is displaced, along x and y.
using Image = std::array<std::int8_t, 2>;

inline Vec2 displacement(const Image& image, const Box& box) {
  return {image[0] * box.size().x(), image[1] * box.size().y()};
}

inline Image opposite(const Image& image) {
  return {static_cast<std::int8_t>(-image[0]), static_cast<std::int8_t>(-image[1])};
}
inline Image operator+(const Image& a, const Image& b) {
  return {static_cast<std::int8_t>(a[0] + b[0]), static_cast<std::int8_t>(a[1] + b[1])};
}
inline Image operator-(const Image& a, const Image& b) { return a + opposite(b); }

/// z component of the cross product; positive when b lies to the left of a.
inline double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// v turned by +90 degrees.
inline Vec2 left_of(const Vec2& v) { return {-v.y(), v.x()}; }

/// v turned by -90 degrees. The outward normal of a wall, since closed cells run counter-clockwise.
inline Vec2 right_of(const Vec2& v) { return {v.y(), -v.x()}; }

}  // namespace lamella
