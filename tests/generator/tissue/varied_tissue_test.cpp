// Whole scenes whose tissue fills a domain, varies from place to place, or is drawn out.
#include "generator/tissue/varied_tissue.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <cstring>
#include <functional>
#include <numbers>

#include "generator/packing/domain.h"
#include "generator/packing/variation.h"
#include "generator/sample/errors.h"
#include "generator/tissue/inset_areas.h"

namespace lamella {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

Scene tissue(int count) {
  Scene scene;
  scene.sample.kind = "tissue";
  scene.stages.emplace_back();
  CellScene cells;
  cells.thickness = 0.02;
  scene.stages.front().cells["cells"] = cells;
  scene.sample.packing.count = count;
  scene.sample.packing.fraction = 0.75;
  scene.sample.sizes.cv = 0.15;
  scene.sample.walls.segments = 4;
  return scene;
}

Scene in_domain(int count, DomainScene domain) {
  Scene scene = tissue(count);
  scene.sample.domain = std::move(domain);
  return scene;
}

Scene in_box(int count, double width, double height) {
  Scene scene = tissue(count);
  scene.sample.width = width;
  scene.sample.height = height;
  return scene;
}

DomainScene disk() { return {.kind = "disk", .radius = 10, .points = {}, .holes = {}}; }
DomainScene ring() { return {.kind = "ring", .radius = 10, .inner_radius = 4, .points = {}, .holes = {}}; }
DomainScene polygon() {
  return {.kind = "polygon",
          .points = {{0, 0}, {20, 0}, {20, 8}, {8, 8}, {8, 20}, {0, 20}},
          .holes = {{{}, Vec2(4, 4), 2.0}, {{{12, 2}, {17, 2}, {15, 5}}, Vec2::Zero(), {}}}};
}

/// The disk of a cell.
const Disk& disk_of(const Origin& origin, Index cell) {
  return origin.packing.disks[std::stoul(origin.tiles.cells[cell].name.substr(5))];
}

double sum_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum;
}

TEST(VariedTissue, fills_disks_rings_and_polygons_with_holes_and_repeats_bit_for_bit) {
  for (const DomainScene& domain : {disk(), ring(), polygon()}) {
    const Scene scene = in_domain(150, domain);
    Notes notes;
    const Sample sample = generate(scene, notes);
    EXPECT_THAT(check_sample(sample), IsEmpty()) << domain.kind;
    EXPECT_EQ(sample.cells(), 150) << domain.kind;
    const Domain asked = make_domain(domain);
    EXPECT_NEAR(sum_of(sample.tile_area) / asked.area, 1, 1e-12) << domain.kind;
    EXPECT_EQ(sample.box.lo, asked.box.lo);
    EXPECT_EQ(sample.box.hi, asked.box.hi);
    for (const Vec2& x : sample.x) EXPECT_TRUE(asked.contains(x)) << domain.kind << " " << x.transpose();
    for (const Side side : {kLeft, kRight, kBottom, kTop}) {
      int nodes = 0;
      for (const auto bits : sample.side) nodes += (bits & side) != 0;
      EXPECT_GT(nodes, 5) << domain.kind << " side " << int{side};
    }
    const Sample again = generate(scene, notes);
    ASSERT_EQ(again.x.size(), sample.x.size());
    EXPECT_EQ(std::memcmp(again.x.data(), sample.x.data(), sample.x.size() * sizeof(Vec2)), 0);
    Scene other = scene;
    other.seed = 5;
    EXPECT_NE(generate(other, notes).x, sample.x);
  }
}

TEST(VariedTissue, of_a_rectangular_domain_carries_side_bits_all_along_its_sides) {
  DomainScene rectangle{.kind = "polygon", .points = {{0, 0}, {10, 0}, {10, 6}, {0, 6}}, .holes = {}};
  Notes notes;
  Origin origin;
  const Mosaic mosaic = make_domain_mosaic(in_domain(60, rectangle), notes, {}, origin);
  std::array<double, 16> length{};
  for (const MosaicCell& cell : mosaic.cells)
    for (std::size_t k = 0; k < cell.vertex.size(); ++k)
      length[cell.side[k]] +=
          (mosaic.vertices[cell.vertex[(k + 1) % cell.vertex.size()]] - mosaic.vertices[cell.vertex[k]]).norm();
  EXPECT_NEAR(length[kLeft], 6, 1e-12);
  EXPECT_NEAR(length[kRight], 6, 1e-12);
  EXPECT_NEAR(length[kBottom], 10, 1e-12);
  EXPECT_NEAR(length[kTop], 10, 1e-12);
}

TEST(VariedTissue, of_a_domain_too_thin_for_its_walls_names_the_cells) {
  Scene scene = in_domain(40, {.kind = "ring", .radius = 10, .inner_radius = 9.5, .points = {}, .holes = {}});
  scene.sample.packing.fraction = 0.1;
  scene.stages.front().cells["cells"].thickness = 1;
  Notes notes;
  try {
    generate(scene, notes);
    FAIL() << "no error";
  } catch (const SceneError& error) {
    EXPECT_THAT(error.what(), HasSubstr("site "));
  }
}

TEST(VariedTissue, takes_groups_from_layers_the_last_of_which_counts) {
  Scene scene = in_box(200, 20, 20);
  scene.sample.layers = {{.from = 0, .to = 6, .polygon = {}, .group = "skin"},
                         {.along = "radius", .from = 0, .to = 5, .polygon = {}, .group = "core"},
                         {.from = 0, .to = 6, .polygon = {{0, 0}, {4, 0}, {4, 4}, {0, 4}}, .group = "corner"}};
  CellScene thick = scene.stages.front().cells["cells"];
  thick.thickness = 0.1;
  scene.stages.front().cells["skin"] = thick;
  Notes notes;
  Origin origin;
  const Sample sample = generate(scene, notes, {}, &origin);
  EXPECT_THAT(check_sample(sample), IsEmpty());
  std::map<std::string, int> count;
  for (Index c = 0; c < sample.cells(); ++c) {
    const Vec2 at = disk_of(origin, c).centre;
    const double radius = (at - Vec2(10, 10)).norm();
    const std::string& group = sample.group_names[sample.group[c]];
    ++count[group];
    EXPECT_DOUBLE_EQ(sample.radius[c], group == "skin" ? 0.05 : 0.01);
    const bool corner = at.x() < 4 && at.y() < 4;
    EXPECT_EQ(group, corner ? "corner" : radius < 5 ? "core" : at.y() < 6 ? "skin" : "cells");
  }
  EXPECT_EQ(count.size(), 4u);
  for (const Link& link : sample.links) {
    const Wall& wall = sample.walls[link.wall];
    EXPECT_GT(link.offset_n, 0.5 * (sample.radius[wall.cell_a] + sample.radius[wall.cell_b]));
  }
}

TEST(VariedTissue, keeps_groups_of_a_mixture_unless_a_layer_has_its_own) {
  Scene scene = in_box(100, 10, 10);
  scene.sample.sizes.distribution = "mixture";
  scene.sample.sizes.mixture = {{.mean = 1, .cv = 0.1, .share = 0.5, .area_share = {}, .group = "small"},
                                {.mean = 2, .cv = 0.1, .share = 0.5, .area_share = {}, .group = "large"}};
  scene.sample.layers = {{.from = 0, .to = 4, .polygon = {}, .group = "cells"},
                         {.from = 6, .to = 10, .polygon = {}, .group = "top"}};
  Notes notes;
  for (const bool domain : {false, true}) {
    if (domain) {
      scene.sample.width = scene.sample.height = 0;
      scene.sample.domain = DomainScene{.kind = "polygon", .points = {{0, 0}, {10, 0}, {10, 10}, {0, 10}}, .holes = {}};
    }
    const Sample sample = generate(scene, notes);
    std::map<std::string, std::vector<double>> areas;
    for (Index c = 0; c < sample.cells(); ++c)
      areas[sample.group_names[sample.group[c]]].push_back(sample.tile_area[c]);
    EXPECT_EQ(areas.size(), 3u);
    EXPECT_FALSE(areas.contains("cells"));
    const auto mean = [&](const char* group) {
      return sum_of(areas[group]) / static_cast<double>(areas[group].size());
    };
    EXPECT_GT(mean("large"), 2 * mean("small"));
    EXPECT_GT(areas["top"].size(), 10u);
  }
}

TEST(VariedTissue, says_which_layer_holds_no_cell) {
  Scene scene = in_box(50, 10, 10);
  scene.sample.layers = {{.from = 20, .to = 30, .polygon = {}, .group = "far"}};
  Notes notes;
  generate(scene, notes);
  EXPECT_THAT(notes, Contains(HasSubstr("layer 0 (group \"far\") holds the centre of no disk")));
}

TEST(VariedTissue, thickens_walls_along_a_gradient) {
  Scene scene = in_box(150, 20, 10);
  scene.sample.gradient = GradientScene{.along = "x", .size = {}, .thickness = {{5, 1}, {15, 4}}, .strength = {}};
  Notes notes;
  Origin origin;
  const Sample sample = generate(scene, notes, {}, &origin);
  EXPECT_THAT(check_sample(sample), IsEmpty());
  ASSERT_EQ(sample.cell_thickness.size(), static_cast<std::size_t>(sample.cells()));
  EXPECT_TRUE(sample.link_strength.empty());
  const auto factor =
      gradient_factor(*scene.sample.gradient, scene.sample.gradient->thickness, "thickness", sample.box);
  for (Index c = 0; c < sample.cells(); ++c) {
    EXPECT_DOUBLE_EQ(sample.radius[c], 0.01 * sample.cell_thickness[c]);
    EXPECT_DOUBLE_EQ(sample.cell_thickness[c], factor(disk_of(origin, c).centre));
  }
}

TEST(VariedTissue, strengthens_links_along_a_gradient_whatever_a_notch_takes_away) {
  Scene scene = in_domain(150, disk());
  scene.sample.gradient =
      GradientScene{.along = "radius", .size = {}, .thickness = {}, .strength = {{0, 0.5}, {10, 2}}};
  for (const bool notched : {false, true}) {
    if (notched) scene.sample.notch = NotchScene{{{-12, 0}, {-2, 0.5}}, {{1, 1}, {5, 1}, {5, 5}, {1, 5}}};
    Notes notes;
    const Sample sample = generate(scene, notes);
    EXPECT_THAT(check_sample(sample), IsEmpty());
    if (notched) {
      EXPECT_THAT(notes, Contains(HasSubstr("the notch removes")));
      EXPECT_THAT(notes, Contains(HasSubstr("the notch cuts")));
    }
    EXPECT_TRUE(sample.cell_thickness.empty());
    ASSERT_EQ(sample.link_strength.size(), sample.links.size());
    for (std::size_t l = 0; l < sample.links.size(); ++l) {
      const Vec2 middle = (sample.x[sample.links[l].a] + sample.x[sample.links[l].b]) / 2;
      EXPECT_NEAR(sample.link_strength[l], 0.5 + 0.15 * middle.norm(), 1e-12);
    }
  }
}

TEST(VariedTissue, has_larger_cells_where_the_gradient_of_size_says_so) {
  Scene scene = in_box(400, 20, 10);
  scene.sample.sizes.cv = 0.05;
  scene.sample.gradient = GradientScene{.along = "x", .size = {{0, 1}, {20, 3}}, .thickness = {}, .strength = {}};
  Notes notes;
  const Sample sample = generate(scene, notes);
  EXPECT_THAT(check_sample(sample), IsEmpty());
  // Areas grow with the square of the factor: compare the quarters at the two ends.
  double left = 0, right = 0;
  int left_count = 0, right_count = 0;
  for (Index c = 0; c < sample.cells(); ++c) {
    const Vec2 at =
        polygon_centre({sample.x.begin() + sample.cell_begin[c], sample.x.begin() + sample.cell_begin[c + 1]});
    if (at.x() < 5) left += sample.tile_area[c], ++left_count;
    if (at.x() > 15) right += sample.tile_area[c], ++right_count;
  }
  // Cells per area go as 1 / factor^2: the mean of the area is the harmonic one, int dx / int dx / f^2 = f1 f2.
  const double expected = (2.5 * 3) / (1 * 1.5);
  EXPECT_NEAR(right / right_count / (left / left_count) / expected, 1, 0.12);
}

/// Mean second moments of the cells about their centres, over their areas.
Eigen::Matrix2d mean_inertia(const Mosaic& mosaic) {
  Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
  for (const MosaicCell& cell : mosaic.cells) {
    const auto points = polygon_of(mosaic, cell);
    const Vec2 centre = polygon_centre(points);
    Eigen::Matrix2d own = Eigen::Matrix2d::Zero();
    double area = 0;
    for (std::size_t k = 0; k < points.size(); ++k) {
      const Vec2 a = points[k] - centre, b = points[(k + 1) % points.size()] - centre;
      const double twice = cross(a, b);
      own += twice / 24 * (2 * a * a.transpose() + 2 * b * b.transpose() + a * b.transpose() + b * a.transpose());
      area += twice / 2;
    }
    sum += own / (area * area);
  }
  return sum / static_cast<double>(mosaic.cells.size());
}

TEST(VariedTissue, is_drawn_out_by_the_ratio_and_along_the_angle_that_are_asked) {
  for (const bool box : {true, false})
    for (const double degrees : {30.0, 0.0, 100.0}) {
      Scene scene = box ? in_box(900, 30, 20) : in_domain(900, disk());
      const double angle = degrees * std::numbers::pi / 180;
      scene.sample.stretch = StretchScene{.ratio = 2, .angle = angle};
      Notes notes;
      Origin origin;
      const Mosaic mosaic = make_domain_mosaic(scene, notes, {}, origin);
      EXPECT_EQ(mosaic.cells.size(), 900u);
      double area = 0;
      for (const MosaicCell& cell : mosaic.cells) area += polygon_area(polygon_of(mosaic, cell));
      EXPECT_NEAR(area / (box ? 600 : make_domain(disk()).area), 1, 1e-12);
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(mean_inertia(mosaic));
      // Moments go as the square of the lengths. 900 cells of about 10 % spread each: 0.5 % of the ratio, 0.3 degrees.
      EXPECT_NEAR(std::sqrt(axes.eigenvalues()[1] / axes.eigenvalues()[0]), 2, 0.08) << degrees << " box " << box;
      const Vec2 along = axes.eigenvectors().col(1);
      EXPECT_LT(std::abs(cross(along, Vec2(std::cos(angle), std::sin(angle)))), std::sin(2 * std::numbers::pi / 180));
    }
}

/// Areas of the tiles over the squares of the radii of their disks, largest over smallest: 1 when they are in proportion.
double spread_of_shares(const Sample& sample, const Origin& origin) {
  double least = 1e300, most = 0;
  for (Index c = 0; c < sample.cells(); ++c) {
    const double radius = disk_of(origin, c).radius, share = sample.tile_area[c] / (radius * radius);
    least = std::min(least, share), most = std::max(most, share);
  }
  return most / least;
}

TEST(VariedTissue, that_repeats_is_drawn_out_along_its_axes_and_goes_on_repeating) {
  for (const std::string periodic : {"x", "y", "xy"})
    for (const double degrees : {0.0, 90.0})
      for (const bool exact : {false, true}) {
        SCOPED_TRACE(testing::Message() << periodic << " " << degrees << " " << exact);
        Scene scene = in_box(600, 30, 20);
        scene.sample.periodic = periodic;
        scene.sample.walls.weld = 0;
        scene.sample.stretch = StretchScene{.ratio = 2, .angle = degrees * std::numbers::pi / 180};
        if (exact) scene.sample.areas = AreasScene{};
        Notes notes;
        Origin origin;
        const Sample sample = generate(scene, notes, {}, &origin);
        EXPECT_EQ(sample.box.hi, Vec2(30, 20));
        EXPECT_NEAR(sum_of(sample.tile_area), 600, 1e-9);
        const Eigen::Matrix2d inertia = mean_inertia(origin.tiles);
        const double along = degrees == 0 ? inertia(0, 0) / inertia(1, 1) : inertia(1, 1) / inertia(0, 0);
        EXPECT_NEAR(std::sqrt(along), 2, 0.1);
        if (exact) {
          EXPECT_LT(spread_of_shares(sample, origin), 1 + 3e-9);
        }
      }
}

TEST(VariedTissue, drawn_out_in_a_box_is_sound_and_meets_all_four_sides) {
  Scene scene = in_box(200, 20, 10);
  scene.sample.stretch = StretchScene{.ratio = 2.5, .angle = 0.6};
  Notes notes;
  const Sample sample = generate(scene, notes);
  EXPECT_THAT(check_sample(sample), IsEmpty());
  EXPECT_EQ(sample.box.hi, Vec2(20, 10));
  EXPECT_NEAR(sum_of(sample.tile_area), 200, 1e-9);
  for (const Side side : {kLeft, kRight, kBottom, kTop}) {
    double reached = 0;
    for (Index k = 0; k < sample.nodes(); ++k) reached += (sample.side[k] & side) != 0;
    EXPECT_GT(reached, 20);
  }
}

TEST(VariedTissue, without_a_box_cannot_be_drawn_out) {
  Scene scene = tissue(50);
  scene.sample.stretch = StretchScene{.ratio = 2, .angle = 0};
  Notes notes;
  EXPECT_THROW(generate(scene, notes), SceneError);
}

TEST(VariedTissue, of_bricks_comes_through_the_front_door) {
  Scene scene = tissue(0);
  scene.sample.kind = "bricks";
  scene.sample.columns = 5;
  scene.sample.rows = 4;
  scene.sample.brick = Vec2(3, 1);
  Notes notes;
  const Sample sample = generate(scene, notes);
  EXPECT_THAT(check_sample(sample), IsEmpty());
  EXPECT_EQ(sample.cells(), 22);
  EXPECT_NEAR(sum_of(sample.tile_area), 60, 1e-12);
}

TEST(VariedTissue, has_exact_areas_in_domains_and_when_drawn_out) {
  Scene hollow = in_domain(150, ring()), leaf = in_domain(150, polygon()), drawn = in_box(150, 20, 10);
  leaf.sample.areas = AreasScene{.of = "tile", .sites = "random", .sweeps = 6};
  hollow.sample.areas = drawn.sample.areas = AreasScene{};
  drawn.sample.stretch = StretchScene{.ratio = 2, .angle = 0.6};
  for (Scene& scene : {std::ref(hollow), std::ref(leaf), std::ref(drawn)}) {
    scene.sample.walls.weld = 0;
    scene.stages.front().cells["cells"].thickness = 1e-4;  // walls without length, next to it, must not vanish
    Notes notes;
    Origin origin;
    const Sample sample = generate(scene, notes, {}, &origin);
    // Edges of a millionth of the mean wall are welded all the same.
    EXPECT_LT(spread_of_shares(sample, origin), 1 + 1e-6);
    scene.sample.areas.reset();
    EXPECT_GT(spread_of_shares(generate(scene, notes, {}, &origin), origin), 1.1);
  }
}

TEST(VariedTissue, has_exact_insets_where_walls_vary) {
  Scene scene = in_box(150, 20, 10);
  scene.sample.walls.weld = 0;
  scene.sample.areas = AreasScene{.of = "inset"};
  scene.sample.layers = {LayerScene{.from = 7, .to = 10, .polygon = {}, .group = "skin"}};
  scene.stages.front().cells["skin"] = scene.stages.front().cells["cells"];
  scene.stages.front().cells["skin"].thickness = 0.1;
  GradientScene gradient;
  gradient.along = "x";
  gradient.thickness = {{0, 1}, {20, 3}};
  scene.sample.gradient = gradient;
  Notes notes;
  Origin origin;
  const Sample sample = generate(scene, notes, {}, &origin);
  double least = 1e300, most = 0;
  for (Index c = 0; c < sample.cells(); ++c) {
    const double radius = disk_of(origin, c).radius;
    const double share =
        inset_area(polygon_of(origin.tiles, origin.tiles.cells[c]), sample.radius[c]) / (radius * radius);
    least = std::min(least, share), most = std::max(most, share);
  }
  EXPECT_LT(most / least, 1 + 1e-8);
}
}  // namespace
}  // namespace lamella
