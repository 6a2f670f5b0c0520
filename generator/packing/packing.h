// Dense packings of disks that do not overlap: minimisation of the overlap of disks that start at random.
#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "generator/sample/scene.h"
#include "generator/sample/vec.h"

namespace lamella {

struct Domain;

struct Disk {
  Vec2 centre = Vec2::Zero();  // [m]
  double radius = 0;           // [m]
};

/// Disks in a box. Between walls every disk lies inside the box; across a periodic pair of sides disks may reach, and
/// the images at whole box lengths belong to the packing.
struct Packing {
  Box box;
  Periodic periodic{false, false};
  std::vector<Disk> disks;
  std::vector<int> number;  // of each disk in its file, from 0, where others are left out; else empty: its place here
  std::vector<double>
      target_area;  // of each disk's cell, where a file states it [m2]; empty: in proportion to the disks
  std::vector<std::string> group;  // of each disk's cell; empty: "cells"
  std::vector<int> part;           // of each disk, of a mixture whose parts state their share of the area; else empty
  std::vector<double> area_share;  // of each such part
  std::vector<double> thickness;   // factor on the wall's thickness of each disk's cell; empty: 1
  double fraction = 0;             // area of the disks over area of the box, or of the domain [1]
  double size_deviation = 0;       // of radii that depend on the place: largest relative error [1]
  std::vector<std::string> notes;  // what the user should see
};

using PackingProgress = std::function<void(double done, const std::string& what)>;

/// A factor on the radii that depends on the place [m]; positive.
using SizeFactor = std::function<double(const Vec2&)>;

/// Where disks are packed.
struct PackingSpace {
  double width = 0, height = 0;    // of the box [m]
  const Domain* domain = nullptr;  // instead of the box
  SizeFactor factor;               // empty: 1
};

/// The disks that a scene asks for: read from packing.file, or drawn and packed, in sample.domain where there is one.
/// Tissues and rings start here.
Packing make_packing(const Scene& scene, const PackingProgress& progress = {}, const SizeFactor& factor = {});

/// Packs disks of these radii at packing.fraction, in an order and a place of its own choice: disk k has the k-th radius.
/// Width and height [m]: radii are scaled so that they fill the fraction; if one is 0 it follows from the other and the
/// radii as given, if both are 0 the box is a square. The box starts at the origin. In a domain the disks lie wholly
/// inside, and radii are scaled too. With a factor, the k-th disk has the k-th radius times the factor at its place, times
/// a common scale, up to Packing::size_deviation. packing.jammed compresses until the packing carries pressure, and
/// returns it where the pressure vanishes; with the space given it is the radii that grow. No two disks overlap, in the
/// arithmetic of `largest_overlap`. Throws SceneError when the fraction cannot be met.
Packing pack(const PackingScene& packing, const std::vector<double>& radii, const PackingSpace& space,
             std::uint64_t seed, const PackingProgress& progress = {});
/// The same in a box.
Packing pack(const PackingScene& packing, const std::vector<double>& radii, double width, double height,
             std::uint64_t seed, const PackingProgress& progress = {});

/// Largest overlap of any two disks, or of a disk with a wall, by a search of its own that shares nothing with the packer [m].
/// Negative: the smallest gap.
double largest_overlap(const Packing& packing);
/// The same, and of any disk with the boundary of the domain.
double largest_overlap(const Packing& packing, const Domain& domain);

/// Area of the disks over area of the box [1].
double area_fraction(const std::vector<Disk>& disks, const Box& box);

}  // namespace lamella
