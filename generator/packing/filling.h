// From disks at random to a packing: what `pack` does, in the coordinates and with the types of the relaxation.
#pragma once
#include <vector>

#include "generator/packing/domain.h"
#include "generator/packing/packing.h"
#include "generator/packing/random.h"
#include "generator/packing/relaxation.h"

namespace lamella {

/// Disks on their way into a box, or into a domain. Coordinates start at the lower left corner of the box, or of the domain's.
struct Filling {
  SoftDisks soft;
  std::vector<double> drawn;       // radii before the factor of the place and the common scale [m]
  const Domain* domain = nullptr;  // null: the box
  SizeFactor factor;               // empty: 1

  Vec2 origin() const { return domain ? domain->box.lo : Vec2::Zero(); }
  bool contains(const Vec2& x) const { return !domain || domain->contains(origin() + x); }
  double factor_at(const Vec2& x) const { return factor ? factor(origin() + x) : 1; }
};

double fraction_of(const SoftDisks& disks);

/// Disks at random, as dense as the factor of the place asks, with radii that fill `fraction`.
Filling random_start(const std::vector<double>& radii, double fraction, const PackingSpace& space, Periodic periodic,
                     Random& random);

/// Moves disks out of parts of a domain where chance has put too many: through a narrow passage they would not find.
void even_out(Filling& filling, Random& random, const PackingProgress& progress);

/// Pushes the disks apart while their radii follow their places; afterwards the radii fit to a fraction of a percent unless
/// the factor jumps, and the disks overlap a little yet.
void follow_factor(Filling& filling, const PackingProgress& progress);

/// Pushes the disks apart at the fraction they have. Where they jam instead they are shaken and try again; last, they are
/// jammed from a higher fraction, which packs denser, and given back the room that is then left. Throws SceneError.
void separate(Filling& filling, Random& random, const PackingProgress& progress);

/// Compresses to the fraction `start`, beyond jamming, then shrinks the disks to where the pressure vanishes. Returns the fraction at
/// which they jam. Once that is known to be below `needed`, it is a guess, and the disks are left as they are then.
double jam(SoftDisks& disks, double start, const PackingProgress& progress, double needed = 0);

/// Of each disk: relative difference of its radius from what its place asks for, up to the common scale [1].
std::vector<double> size_deviations(const Filling& filling);

}  // namespace lamella
