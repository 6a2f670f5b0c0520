// The tessellation of a tissue whose cells have the areas that the scene asks for.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "generator/generate.h"
#include "generator/packing/domain.h"
#include "generator/packing/laguerre.h"
#include "generator/packing/packing.h"
#include "generator/sample/scene.h"
#include "generator/tissue/mosaic.h"

namespace lamella {

/// Tiles of prescribed areas. What has the area is the tile, or what the inset leaves of it.
struct CellAreas {
  Tessellation tessellation;
  std::vector<Vec2> centres;     // of its sites [m]
  std::vector<double> weights;   // [m2]
  std::vector<double> shares;    // per site, of the sum of all areas: in proportion to what was asked for
  std::vector<double> distance;  // per site, of the inset [m]; empty: whole tiles

  /// Disks with these tiles: all weights moved by one number, so that each is the square of a radius.
  std::vector<Disk> sites() const;
};

/// Tessellates with sites from the packing, weights solved for, and sweeps as asked. `distance`: per disk, by which walls
/// move in. Notes say what was reached. Throws SceneError for what cannot be.
CellAreas tessellate_with_areas(const Packing& packing, const AreasScene& scene, const Periodic& periodic,
                                const std::vector<double>& distance, Notes& notes,
                                const std::function<void(double done, const std::string& what)>& progress = {});

/// The same in a domain, whose tiles [sample.areas] of = "inset" does not know: throws SceneError for it. The tessellation is that of a box
/// around the domain: what the domain leaves of its tiles has the areas.
CellAreas tessellate_with_areas(const Packing& packing, const AreasScene& scene, const Domain& domain, Notes& notes,
                                const std::function<void(double done, const std::string& what)>& progress = {});

/// Notes what welding, which comes last, has done to the areas.
void note_welded_areas(const CellAreas& exact, const Tessellation& welded, int count, Notes& notes);
/// The same of areas per site.
void note_welded_areas(const std::vector<double>& before, const std::vector<double>& after, int count, Notes& notes);

/// Notes how far the polygons of mass points are from the insets: those near a corner are merged with it, which cuts it off.
/// The first cells of the sample are those of the mosaic.
void note_enclosed_areas(const Mosaic& mosaic, double gap, const Sample& sample, Notes& notes);

}  // namespace lamella
