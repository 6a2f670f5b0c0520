// Tissues that fill a domain, or vary from place to place: which scene makes which mosaic.
#pragma once
#include <functional>
#include <string>

#include "generator/generate.h"
#include "generator/packing/packing.h"
#include "generator/sample/scene.h"
#include "generator/tissue/mosaic.h"

namespace lamella {

using TissueProgress = std::function<void(double, const std::string&)>;

/// The tissue of [sample.domain], of the box where [sample.stretch] stands alone: packed, clipped, short edges welded, drawn out. Names
/// of cells are those of their sites; groups of a mixture are set. `origin` gets the disks, before they are drawn out, and what was
/// welded and hidden.
Mosaic make_domain_mosaic(const Scene& scene, Notes& notes, const TissueProgress& progress, Origin& origin);

/// Groups and thickness factors of the disks' cells as [[sample.layers]] and [sample.gradient] say at the place of the disk, which also
/// decides its size: a layer's group replaces what the disk has unless it is "cells". `map` takes centres to where they are drawn out
/// to, `box` is that of the tissue. Notes name layers without a disk.
void vary_disks(Packing& packing, const SampleScene& scene, const Box& box, const Eigen::Matrix2d& map, Notes& notes);

/// Gives each cell what its disk has; `site` is that of each cell.
void take_from_disks(const Packing& packing, const std::vector<Index>& site, Mosaic& mosaic);

/// By how much the wall of each disk's cell moves in: radius of its group times thickness factor, and half the gap [m].
std::vector<double> inset_distances(const Packing& packing, const Scene& scene);

/// Strength factors of links by [sample.gradient], at the middle between the two nodes; thickness factors of shells that are no
/// cells of the tissue. Nothing where nothing varies.
void vary_links(Sample& sample, const SampleScene& scene);

}  // namespace lamella
