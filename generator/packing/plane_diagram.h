// The power diagram of a box as part of the plane: sites as given, or, where the box is periodic, with as many of their
// images as it takes for the cells of the sites in the box to be those of the infinite plane.
#pragma once
#include <array>
#include <vector>

#include "generator/packing/power_diagram.h"

namespace lamella {

/// Something of the box, displaced by a number of its lengths.
struct Copy {
  Index of = 0;
  Image image{0, 0};
};

struct PlaneDiagram {
  Box box;                     // in the diagram's coordinates
  Vec2 origin = Vec2::Zero();  // of the diagram's coordinates: the box's lower corner along periodic axes [m]
  Periodic periodic{false, false};
  Index sites = 0;              // in the box; copies follow
  std::vector<PowerSite> site;  // in the diagram's coordinates
  std::vector<Copy> copy;       // of site[sites + k]
  std::vector<Image> wrapped;   // per site: it was given at site + wrapped box lengths; empty: none was outside
  PowerDiagram diagram;
  std::vector<Copy> canonical;  // per vertex: the vertex that stands for all its images; empty: each is its own

  Copy site_copy(Index i) const { return i < sites ? Copy{i, {0, 0}} : copy[i - sites]; }
  Copy vertex_copy(Index v) const { return canonical.empty() ? Copy{v, {0, 0}} : canonical[v]; }
};

/// Sites inside or on the box; along periodic axes anywhere within 100 boxes.
///
/// Why the copies suffice. Cells of the plane are cut by the site's own images, so a cell lies within half a box of its
/// site along every periodic axis, and neighbours within a whole one: of each site, the copies displaced by -1, 0 and 1
/// are all that matter. Of these, copies are left out when they are further than sqrt(rho + w) from a rectangle E, where w
/// is their weight. They change nothing if no corner c of a cell prefers them: |c - p|^2 - w >= power(c). With c at depth
/// delta inside E that holds when power(c) - delta^2 <= rho, which is checked at all corners of the cells found. If not,
/// the largest value found takes the place of rho; more copies only make cells smaller, and the value, convex in c,
/// cannot grow, so that the second try passes.
///
/// Coordinates along periodic axes are rounded to a grid (2^-51 of the box or finer) on which displacements are exact. So
/// exact predicates see the same configuration in every image, cocircular ones included.
///
/// `reach`: a guess of that value [m2], were the mean weight zero, such as this leaves for the next call with nearly the same sites and weights; 0: none.
PlaneDiagram plane_diagram(std::vector<PowerSite> sites, const Box& box, Periodic periodic, double* reach = nullptr);

}  // namespace lamella
