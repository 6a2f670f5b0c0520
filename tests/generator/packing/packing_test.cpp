#include "generator/packing/packing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numeric>

#include "generator/packing/laguerre.h"
#include "generator/packing/sizes.h"
#include "generator/sample/errors.h"
#include "random_disks.h"
#include "tests/support/temporary_folder.h"

namespace lamella {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

PackingScene asked(const std::string& boundary, double fraction) {
  PackingScene scene;
  scene.boundary = boundary;
  scene.fraction = fraction;
  return scene;
}

std::vector<double> lognormal_radii(int count, double cv, std::uint64_t seed) {
  SizesScene sizes;
  sizes.cv = cv;
  return draw_radii(sizes, count, seed, {});
}

/// Oracle: every pair, every image.
double brute_force_overlap(const Packing& packing) {
  double largest = -1e300;
  const Vec2 size = packing.box.size();
  for (std::size_t i = 0; i < packing.disks.size(); ++i) {
    const Disk& a = packing.disks[i];
    for (const int axis : {0, 1})
      if (!packing.periodic[axis])
        largest = std::max(
            {largest, a.radius - (a.centre - packing.box.lo)[axis], a.radius - (packing.box.hi - a.centre)[axis]});
    for (std::size_t j = 0; j < packing.disks.size(); ++j) {
      for (int ix = -1; ix <= 1; ++ix) {
        for (int iy = -1; iy <= 1; ++iy) {
          if (i == j && ix == 0 && iy == 0) continue;
          if ((ix != 0 && !packing.periodic[0]) || (iy != 0 && !packing.periodic[1])) continue;
          const Vec2 d = packing.disks[j].centre + size.cwiseProduct(Vec2(ix, iy)) - a.centre;
          largest = std::max(largest, a.radius + packing.disks[j].radius - d.norm());
        }
      }
    }
  }
  return largest;
}

TEST(packing, disks_fill_the_fraction_asked_for_and_do_not_overlap) {
  for (const double cv : {0.0, 0.1, 0.3, 0.6}) {
    for (const auto& [boundary, fraction] :
         {std::pair{"walls", 0.81}, {"periodic", 0.83}, {"periodic_x", 0.82}, {"periodic_y", 0.82}}) {
      const auto radii = lognormal_radii(400, cv, 2);
      const Packing packing = pack(asked(boundary, fraction), radii, 0, 0, 2);
      EXPECT_NEAR(packing.fraction, fraction, 1e-12) << boundary << " CV " << cv;
      EXPECT_LE(brute_force_overlap(packing), 0) << boundary << " CV " << cv;
      for (std::size_t k = 0; k < radii.size(); ++k) EXPECT_EQ(packing.disks[k].radius, radii[k]);
    }
  }
}

TEST(packing, the_search_for_overlaps_agrees_with_trying_all_pairs) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    Packing packing;
    packing.box = {{0, 0}, {1, 0.7}};
    packing.disks = random_disks(60, 0.05, seed, 1, 0.7);
    for (const Periodic periodic : {Periodic{false, false}, {true, false}, {false, true}, {true, true}}) {
      packing.periodic = periodic;
      EXPECT_NEAR(largest_overlap(packing), brute_force_overlap(packing), 1e-15);
    }
  }
}

TEST(packing, radii_are_scaled_to_a_given_box) {
  const auto radii = lognormal_radii(300, 0.2, 3);
  const Packing packing = pack(asked("walls", 0.78), radii, 3e-4, 2e-4, 3);
  EXPECT_EQ(packing.box.size(), Vec2(3e-4, 2e-4));
  EXPECT_NEAR(packing.fraction, 0.78, 1e-12);
  EXPECT_LE(brute_force_overlap(packing), 0);
  for (std::size_t k = 1; k < radii.size(); ++k)
    EXPECT_NEAR(packing.disks[k].radius / packing.disks[0].radius, radii[k] / radii[0], 1e-12);
}

TEST(packing, a_missing_side_of_the_box_follows_from_the_disks) {
  const auto radii = lognormal_radii(200, 0.1, 4);
  const Packing packing = pack(asked("periodic", 0.75), radii, 20, 0, 4);
  EXPECT_EQ(packing.box.size().x(), 20);
  EXPECT_NEAR(packing.fraction, 0.75, 1e-12);
  EXPECT_EQ(packing.disks[7].radius, radii[7]);
}

TEST(packing, jamming_in_a_given_box_grows_the_disks) {
  PackingScene scene = asked("walls", 0.5);
  scene.jammed = true;
  const Packing packing = pack(scene, lognormal_radii(200, 0.2, 5), 2, 1, 5);
  EXPECT_EQ(packing.box.size(), Vec2(2, 1));
  EXPECT_GT(packing.fraction, 0.79);
  EXPECT_LE(brute_force_overlap(packing), 0);
}

TEST(packing, the_same_seed_gives_the_same_packing_bit_for_bit) {
  const auto radii = lognormal_radii(200, 0.2, 6);
  const Packing a = pack(asked("periodic", 0.8), radii, 1, 1, 6), b = pack(asked("periodic", 0.8), radii, 1, 1, 6),
                c = pack(asked("periodic", 0.8), radii, 1, 1, 7);
  for (std::size_t k = 0; k < radii.size(); ++k) EXPECT_EQ(a.disks[k].centre, b.disks[k].centre);
  EXPECT_NE(a.disks[0].centre, c.disks[0].centre);
}

TEST(packing, every_disk_lies_in_its_tile) {
  const Packing packing = pack(asked("walls", 0.81), lognormal_radii(400, 0.3, 8), 1, 1, 8);
  const Tessellation t = tessellate(packing.disks, packing.box);  // and none is hidden
  EXPECT_THAT(check_tessellation(t), IsEmpty());
  for (const Tile& tile : t.tiles) {
    const Disk& disk = packing.disks[tile.site];
    for (std::size_t k = 0; k < tile.vertex.size(); ++k) {
      const Vec2 p = t.vertices[tile.vertex[k]], q = t.vertices[tile.vertex[(k + 1) % tile.vertex.size()]];
      if ((q - p).norm() < 1e-6 * disk.radius) continue;
      EXPECT_GE(cross(q - p, disk.centre - p) / (q - p).norm(), disk.radius * (1 - 1e-9));
    }
  }
}

TEST(packing, very_unequal_disks_are_packed_too) {
  const Packing packing = pack(asked("periodic", 0.8), lognormal_radii(3000, 1.0, 9), 0, 0, 9);
  EXPECT_NEAR(packing.fraction, 0.8, 1e-12);
  EXPECT_LE(brute_force_overlap(packing), 0);
}

TEST(packing, ten_thousand_disks_fill_0_83_of_a_torus) {
  const Packing packing = pack(asked("periodic", 0.83), lognormal_radii(10000, 0.3, 9), 0, 0, 9);
  EXPECT_NEAR(packing.fraction, 0.83, 1e-12);
  EXPECT_LE(largest_overlap(packing), 0);
}

TEST(packing, few_disks_are_packed_too) {
  for (const int count : {1, 2, 3, 5, 10}) {
    for (const char* boundary : {"walls", "periodic"}) {
      const Packing packing = pack(asked(boundary, 0.25), lognormal_radii(count, 0, 1), 0, 0, 1);
      EXPECT_NEAR(packing.fraction, 0.25, 1e-12);
      EXPECT_LE(brute_force_overlap(packing), 0);
    }
  }
}

TEST(packing, a_scene_that_names_a_file_gets_its_disks_and_is_told_of_overlaps) {
  Scene scene;
  const TemporaryFolder folder;
  const auto path = folder / "scene_packing.csv";
  scene.sample.packing.file = path.string();
  std::ofstream(path) << "1,1,0.5\n3,1,0.5\n";
  EXPECT_THAT(make_packing(scene).notes, IsEmpty());
  std::ofstream(path) << "1,1,0.5\n1.75,1,0.5\n";
  EXPECT_THAT(make_packing(scene).notes, ElementsAre(HasSubstr("by up to 0.25 m")));
  std::ofstream(path) << "1,1,0.5,2\n3,1,0.5,2\n";
  EXPECT_THAT(make_packing(scene).notes, ElementsAre(HasSubstr("with a section [sample.areas] only")));
  scene.sample.areas = AreasScene{};
  EXPECT_THAT(make_packing(scene).notes, IsEmpty());
  scene.sample.width = scene.sample.height = 1.5;
  EXPECT_THROW(make_packing(scene), SceneError);  // a centre outside the box
}

TEST(packing, a_sample_that_repeats_gets_a_packing_that_does) {
  Scene scene;
  scene.sample.packing.count = 100;
  scene.sample.packing.fraction = 0.75;
  for (const auto& [periodic, sides] :
       {std::pair{"none", Periodic{false, false}}, {"x", {true, false}}, {"y", {false, true}}, {"xy", {true, true}}}) {
    scene.sample.periodic = periodic;
    const Packing packing = make_packing(scene);
    EXPECT_EQ(packing.periodic, sides) << periodic;
    EXPECT_LE(brute_force_overlap(packing), 0);
    bool crosses[2] = {false, false};
    for (const Disk& disk : packing.disks)
      for (const int axis : {0, 1})
        crosses[axis] = crosses[axis] || disk.centre[axis] < packing.box.lo[axis] + disk.radius ||
                        disk.centre[axis] > packing.box.hi[axis] - disk.radius;
    EXPECT_EQ(crosses[0], sides[0]) << periodic;
    EXPECT_EQ(crosses[1], sides[1]) << periodic;
  }
}

TEST(packing, the_cells_of_a_mixture_are_in_their_groups) {
  Scene scene;
  scene.sample.packing.count = 200;
  scene.sample.packing.fraction = 0.75;
  scene.sample.sizes.distribution = "mixture";
  scene.sample.sizes.mixture.resize(2);
  scene.sample.sizes.mixture[0].mean = 1, scene.sample.sizes.mixture[0].cv = 0,
  scene.sample.sizes.mixture[0].share = 0.9;
  scene.sample.sizes.mixture[1].mean = 3, scene.sample.sizes.mixture[1].cv = 0,
  scene.sample.sizes.mixture[1].share = 0.1;
  scene.sample.sizes.mixture[1].group = "vessels";
  const Packing packing = make_packing(scene);
  ASSERT_EQ(packing.group.size(), 200U);
  EXPECT_EQ(std::count(packing.group.begin(), packing.group.end(), "vessels"), 20);
  for (std::size_t k = 0; k < 200; ++k)
    EXPECT_NEAR(packing.disks[k].radius, packing.group[k] == "vessels" ? 3 : 1, 1e-12);
}

std::string message_of(const PackingScene& scene, const std::vector<double>& radii, double width, double height) {
  try {
    pack(scene, radii, width, height, 1);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "no error";
}

TEST(packing, what_cannot_be_packed_is_refused_with_what_can) {
  const auto radii = lognormal_radii(100, 0.1, 1);
  EXPECT_THAT(message_of(asked("walls", 0.95), radii, 0, 0), AllOf(HasSubstr("fraction = 0.95"), HasSubstr("0.81")));
  EXPECT_THAT(message_of(asked("walls", -0.5), radii, 0, 0), HasSubstr("must be positive"));
  EXPECT_THAT(message_of(asked("walls", NAN), radii, 0, 0), HasSubstr("fraction = nan"));
  EXPECT_THAT(message_of(asked("walls", 0.88), radii, 0, 0), HasSubstr("100 disks of these sizes jam at about 0.8"));
  EXPECT_THAT(message_of(asked("torus", 0.8), radii, 0, 0), HasSubstr("\"walls\", \"periodic\""));
  EXPECT_THAT(message_of(asked("walls", 0.8), radii, -1, 0), HasSubstr("sample.width = -1"));
  EXPECT_THAT(message_of(asked("walls", 0.8), radii, 1000, 0.1), HasSubstr("does not fit the box"));
  EXPECT_THAT(message_of(asked("walls", 0.8), {1, -1}, 0, 0), HasSubstr("positive and finite"));
  EXPECT_THAT(message_of(asked("walls", 0.8), {}, 0, 0), HasSubstr("count = 0"));
}

}  // namespace
}  // namespace lamella
