// Contacts of packings whose contacts can be counted otherwise.
#include "generator/statistics/packing_contacts.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lamella {
namespace {

/// Touching disks of radius 1/2 on a triangular lattice that repeats.
Packing triangular(int columns, int rows) {
  Packing packing;
  packing.periodic = {true, true};
  const double height = std::sqrt(3.0) / 2;
  packing.box = {{0, 0}, {static_cast<double>(columns), rows * height}};
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) packing.disks.push_back({{i + 0.5 * (j % 2), j * height}, 0.5});
  packing.fraction = area_fraction(packing.disks, packing.box);
  return packing;
}

TEST(Contacts, of_a_triangular_lattice_are_six_each) {
  const PackingContacts contacts = contacts_of(triangular(6, 4));
  EXPECT_EQ(contacts.contacts, 3 * 24);
  EXPECT_EQ(contacts.coordination, 6);
  EXPECT_EQ(contacts.rattlers, 0);
  EXPECT_NEAR(contacts.fraction, M_PI / (2 * std::sqrt(3.0)), 1e-12);
}

TEST(Contacts, end_at_the_tolerance) {
  Packing packing = triangular(6, 4);
  for (Disk& disk : packing.disks) disk.radius *= 1 - 2e-3;
  EXPECT_EQ(contacts_of(packing, 1e-3).contacts, 0);
  EXPECT_EQ(contacts_of(packing, 1e-3).rattlers, 24);
  EXPECT_EQ(contacts_of(packing, 3e-3).contacts, 72);
}

TEST(Contacts, leave_out_disks_that_nothing_holds_and_those_that_only_these_held) {
  Packing packing = triangular(6, 4);
  packing.disks[7].radius = 0.2;  // free in its cage: its six neighbours keep five contacts each
  const PackingContacts one = contacts_of(packing);
  EXPECT_EQ(one.rattlers, 1);
  EXPECT_EQ(one.contacts, 72 - 6);
  // A chain from wall to wall holds nothing sideways: with its ends gone, all goes.
  Packing chain;
  chain.box = {{0, 0}, {3, 5}};
  for (int i = 0; i < 3; ++i) chain.disks.push_back({{i + 0.5, 2.5}, 0.5});
  EXPECT_EQ(contacts_of(chain).rattlers, 3);
  EXPECT_EQ(contacts_of(chain).coordination, 0);
}

TEST(Contacts, with_walls_hold_a_disk) {
  // Square lattice that fills its box: every disk has four contacts, with disks or walls; pairs are the grid's edges.
  Packing packing;
  packing.box = {{0, 0}, {3, 3}};
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) packing.disks.push_back({{i + 0.5, j + 0.5}, 0.5});
  const PackingContacts contacts = contacts_of(packing);
  EXPECT_EQ(contacts.rattlers, 0);
  EXPECT_EQ(contacts.contacts, 12);
  EXPECT_NEAR(contacts.coordination, 24.0 / 9, 1e-14);
}

TEST(Contacts, of_no_disks_are_none) { EXPECT_EQ(contacts_of({}).disks, 0); }

}  // namespace
}  // namespace lamella
