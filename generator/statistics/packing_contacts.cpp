#include "generator/statistics/packing_contacts.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "generator/tissue/crossings.h"

namespace lamella {
namespace {

struct Contact {
  Index a, b;  // b == -1: a wall
};

double apart(double d, double length, bool periodic) { return periodic ? d - length * std::round(d / length) : d; }

/// Boxes of disks in a grid; across periodic sides by their images.
std::vector<Contact> touching(const Packing& packing, double tolerance) {
  const Vec2 size = packing.box.size();
  const auto count = static_cast<Index>(packing.disks.size());
  Grid grid(packing.box, 0, packing.disks.size());
  std::vector<Contact> found;
  std::vector<int> seen;
  for (Index i = 0; i < count; ++i) {
    const Disk& disk = packing.disks[i];
    const Vec2 reach = Vec2::Constant(disk.radius * (1 + tolerance));
    seen.clear();
    const int x = packing.periodic[0], y = packing.periodic[1];
    for (int dx = -x; dx <= x; ++dx)
      for (int dy = -y; dy <= y; ++dy) {
        const Vec2 at = disk.centre + Vec2(dx * size.x(), dy * size.y());
        const Vec2 lo = at - reach, hi = at + reach;
        if ((hi.array() < packing.box.lo.array()).any() || (lo.array() > packing.box.hi.array()).any()) continue;
        grid.visit(lo, hi, [&](int other) { seen.push_back(other); });
        grid.add(i, lo, hi);
      }
    std::sort(seen.begin(), seen.end());
    seen.erase(std::unique(seen.begin(), seen.end()), seen.end());
    for (const int other : seen) {
      if (other == i) continue;
      const Disk& there = packing.disks[other];
      const Vec2 d(apart(there.centre.x() - disk.centre.x(), size.x(), packing.periodic[0]),
                   apart(there.centre.y() - disk.centre.y(), size.y(), packing.periodic[1]));
      if (d.norm() <= (disk.radius + there.radius) * (1 + tolerance)) found.push_back({other, i});
    }
    for (const int axis : {0, 1}) {
      if (packing.periodic[axis]) continue;
      if (disk.centre[axis] - packing.box.lo[axis] <= disk.radius * (1 + tolerance)) found.push_back({i, -1});
      if (packing.box.hi[axis] - disk.centre[axis] <= disk.radius * (1 + tolerance)) found.push_back({i, -1});
    }
  }
  return found;
}

}  // namespace

PackingContacts contacts_of(const Packing& packing, double tolerance) {
  PackingContacts result;
  result.fraction = packing.fraction;
  result.tolerance = tolerance;
  result.disks = static_cast<Index>(packing.disks.size());
  if (result.disks == 0) return result;
  const auto contacts = touching(packing, tolerance);
  std::vector<std::vector<Index>> around(packing.disks.size());
  std::vector<Index> number(packing.disks.size(), 0);
  for (const Contact& contact : contacts) {
    ++number[contact.a];
    if (contact.b < 0) continue;
    ++number[contact.b];
    around[contact.a].push_back(contact.b);
    around[contact.b].push_back(contact.a);
  }
  std::vector<bool> rattles(packing.disks.size(), false);
  std::vector<Index> loose;
  const auto look_at = [&](Index i) {
    if (rattles[i] || number[i] >= 3) return;
    rattles[i] = true;
    loose.push_back(i);
  };
  for (Index i = 0; i < result.disks; ++i) look_at(i);
  for (std::size_t k = 0; k < loose.size(); ++k)
    for (const Index other : around[loose[k]]) {
      --number[other];
      look_at(other);
    }
  result.rattlers = static_cast<Index>(loose.size());
  for (const Contact& contact : contacts)
    if (contact.b >= 0 && !rattles[contact.a] && !rattles[contact.b]) ++result.contacts;
  const Index carrying = result.disks - result.rattlers;
  result.coordination = carrying > 0 ? 2.0 * result.contacts / carrying : 0;
  return result;
}

}  // namespace lamella
