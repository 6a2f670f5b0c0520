// What the paper says of the contact of an elastic ring, beside what is found: the slope of L_c, F / F* = L_c / l, the plateau p*; and
// the soft plates that imitate it.
#pragma once
#include "pipelines/ring_between_plates/pressed_ring.h"
#include "pipelines/studies/study.h"

namespace lamella {

/// A ring between rigid plates.
struct RigidCase {
  const Squeeze& ring;
  int nodes;
};

void study_contact_claims(StudyBench& bench, const RigidCase& fine, const RigidCase& coarse);
/// Runs soft.toml.
void study_soft_plates(StudyBench& bench, const RigidCase& fine, const RigidCase& coarse);

}  // namespace lamella
