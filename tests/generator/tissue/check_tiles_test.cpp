// Every invariant of tiles, broken on purpose; and every kind of tissue, which breaks none.
#include "generator/tissue/check_tiles.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "generator/generate.h"
#include "generator/tissue/lattice.h"

namespace lamella {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Squares of side 1, columns by rows.
Mosaic squares(Index columns, Index rows) {
  Mosaic mosaic;
  mosaic.box = {{0, 0}, {1.0 * columns, 1.0 * rows}};
  for (Index j = 0; j <= rows; ++j)
    for (Index i = 0; i <= columns; ++i) mosaic.vertices.emplace_back(i, j);
  const auto at = [&](Index i, Index j) { return j * (columns + 1) + i; };
  for (Index j = 0; j < rows; ++j)
    for (Index i = 0; i < columns; ++i) {
      MosaicCell cell;
      cell.vertex = {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)};
      cell.side.assign(4, 0);
      cell.name = "square " + std::to_string(mosaic.cells.size());
      mosaic.cells.push_back(cell);
    }
  return mosaic;
}

const Filled kThreeByTwo{.known = true, .euler = 1, .area = 6, .around = 10};

TEST(CheckTiles, says_what_is_broken) {
  struct Break {
    const char* says;
    std::function<void(Mosaic&)> change;
  };
  const std::vector<Break> breaks{
      {"square 1: a tile of 2 corners", [](Mosaic& m) { m.cells[1].vertex.resize(2); }},
      {"square 1: no vertex 12", [](Mosaic& m) { m.cells[1].vertex[0] = 12; }},
      {"square 1: a tile of area 0", [](Mosaic& m) { m.vertices[1] = m.vertices[6], m.vertices[5] = m.vertices[2]; }},
      {"lie on the same side of a shared wall", [](Mosaic& m) { m.cells[1] = m.cells[0]; }},
      // A wall whose two sides end in vertices of their own, at one place: neither areas nor lengths inside see that.
      {"V - E + F = 13 - 19 + 6",
       [](Mosaic& m) {
         m.vertices.push_back(m.vertices[5]);
         m.cells[0].vertex[2] = 12;
       }},
      {"areas sum to 5 m2 instead of 6", [](Mosaic& m) { m.cells.pop_back(); }},
      {"areas sum to 6.0000000000", [](Mosaic& m) { m.vertices[0] -= Vec2(1e-10, 0); }},
      {"free edges sum to", [](Mosaic& m) { m.vertices[1].y() = 1e-3, m.vertices[2].y() = -1e-3; }},
  };
  EXPECT_THAT(check_tiles(squares(3, 2), kThreeByTwo), IsEmpty());
  for (const Break& broken : breaks) {
    Mosaic mosaic = squares(3, 2);
    broken.change(mosaic);
    EXPECT_THAT(check_tiles(mosaic, kThreeByTwo), Contains(HasSubstr(broken.says)));
  }
}

TEST(CheckTiles, on_a_torus_every_wall_has_two_sides) {
  SampleScene scene;
  scene.kind = "honeycomb";
  scene.columns = 4;
  scene.rows = 4;
  scene.side = 1;
  scene.periodic = "xy";
  Mosaic mosaic = make_honeycomb(scene);
  const Filled filled = filled_by(scene, mosaic.box);
  EXPECT_EQ(filled.around, 0);
  EXPECT_THAT(check_tiles(mosaic, filled), IsEmpty());
  mosaic.cells.pop_back();
  EXPECT_THAT(check_tiles(mosaic, filled), Contains(HasSubstr("has one side only")));
}

TEST(CheckTiles, finds_nothing_wrong_with_tissues_of_any_kind) {
  const auto packed = [](const std::function<void(SampleScene&)>& change) {
    Scene scene;
    scene.stages.emplace_back();
    scene.stages.front().cells["cells"].thickness = 1e-4;
    SampleScene& sample = scene.sample;
    sample.kind = "tissue";
    sample.width = 1.5;
    sample.height = 1;
    sample.packing.count = 150;
    sample.packing.fraction = 0.75;
    sample.sizes.cv = 0.3;
    sample.walls.segments = 6;
    change(sample);
    return scene;
  };
  const std::vector<std::function<void(SampleScene&)>> kinds{
      [](SampleScene&) {},
      [](SampleScene& s) { s.periodic = "x"; },
      [](SampleScene& s) { s.periodic = "xy"; },
      [](SampleScene& s) { s.areas = AreasScene{}, s.areas->sweeps = 2; },
      [](SampleScene& s) { s.areas = AreasScene{}, s.areas->sites = "random", s.periodic = "y"; },
      [](SampleScene& s) {
        s.stretch = StretchScene{2, 0.4};
      },
      [](SampleScene& s) {
        s.domain = DomainScene{};
        s.domain->kind = "ring";
        s.domain->radius = 1;
        s.domain->inner_radius = 0.4;
      },
      [](SampleScene& s) {
        s.kind = "bricks", s.columns = 5, s.rows = 4, s.brick = {2, 1};
      },
      [](SampleScene& s) {
        s.kind = "bricks", s.columns = 5, s.rows = 4, s.brick = {2, 1}, s.periodic = "xy";
      },
      [](SampleScene& s) { s.kind = "honeycomb", s.columns = 5, s.rows = 4, s.side = 1; },
      [](SampleScene& s) { s.kind = "honeycomb", s.columns = 5, s.rows = 4, s.side = 1, s.periodic = "x"; },
  };
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    SCOPED_TRACE(k);
    const Scene scene = packed(kinds[k]);
    Notes notes;
    Origin origin;
    const Sample sample = generate(scene, notes, {}, &origin);
    const Filled filled = filled_by(scene.sample, sample.box);
    EXPECT_TRUE(filled.known);
    EXPECT_THAT(check_tiles(origin.tiles, filled), IsEmpty());
    origin.tiles.cells.erase(origin.tiles.cells.begin() + static_cast<std::ptrdiff_t>(origin.tiles.cells.size() / 2));
    if (filled.area > 0) {
      EXPECT_FALSE(check_tiles(origin.tiles, filled).empty()) << "a tile is missing";
    }
  }
}

}  // namespace
}  // namespace lamella
