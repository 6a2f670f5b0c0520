// Contacts of a packing of disks.
#pragma once
#include "generator/packing/packing.h"
#include "generator/sample/sample.h"

namespace lamella {

struct PackingContacts {
  double fraction = 0;   // area of the disks over area of the box [1]
  double tolerance = 0;  // disks with a smaller gap touch, over the sum of their radii [1]
  Index disks = 0;
  Index contacts = 0;       // pairs of disks, walls not among them, rattlers left out
  Index rattlers = 0;       // with fewer than three contacts, walls included, once such disks are taken away
  double coordination = 0;  // contacts per disk that is no rattler, each pair twice [1]
};

/// Rattlers are taken away in turn until none is left. Of N' others a jammed packing of frictionless disks has
/// 2 N' - 1 contacts (periodic).
PackingContacts contacts_of(const Packing& packing, double tolerance = 1e-3);

}  // namespace lamella
