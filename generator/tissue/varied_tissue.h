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

/// Groups and thicknesses of cells as [[sample.layers]] and [sample.gradient] say, by the cell's centre: a layer's group replaces what
/// the cell has unless it is "cells". Notes name layers without a cell.
void vary_cells(Mosaic& mosaic, const SampleScene& scene, Notes& notes);

/// By how much the walls of each disk's cell move in, were its centre at `places`: radius of its group times thickness factor, and half
/// the gap [m].
std::vector<double> inset_distances(const Packing& packing, const Scene& scene, const std::vector<Vec2>& places);

/// Strength factors of links by [sample.gradient], at the middle between the two nodes; thickness factors of shells that are no
/// cells of the tissue. Nothing where nothing varies.
void vary_links(Sample& sample, const SampleScene& scene);

}  // namespace lamella
