// Tiles clipped by a domain: invariants, brute force, and placements in which the boundary meets vertices and walls.
#include "generator/tissue/domain_tissue.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <set>

#include "generator/generate.h"
#include "generator/packing/weld.h"
#include "generator/sample/errors.h"
#include "tests/generator/tissue/domain_shapes.h"

namespace lamella {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::vector<std::string> kShapes{"disk", "ring", "L", "star", "two holes", "square"};

LaguerreOptions reporting() { return {Duplicates::kKeepFirst, Hidden::kReport}; }

DomainTissue clipped(const std::vector<Disk>& disks, const Loops& loops, Notes& notes) {
  return clip_tiles(tessellate(disks, box_around(loops, disks), reporting()), loops, reporting(), notes);
}

DomainTissue clipped(const std::vector<Disk>& disks, const Loops& loops) {
  Notes notes;
  return clipped(disks, loops, notes);
}

/// Disks on a lattice: four tiles meet at every vertex (i / n, j / n).
std::vector<Disk> lattice(int n) {
  std::vector<Disk> disks;
  for (int j = -1; j <= n; ++j)
    for (int i = -1; i <= n; ++i) disks.push_back({{(i + 0.5) / n, (j + 0.5) / n}, 0.1 / n});
  return disks;
}

TEST(DomainTissue, keeps_every_invariant_for_many_sites_and_few) {
  int made = 0, refused = 0;
  for (const std::string& shape : kShapes)
    for (const int count : {12, 40, 300, 2000})
      for (unsigned seed = 1; seed <= (count < 100 ? 20u : 3u); ++seed) {
        const Loops loops = domain_of(shape);
        try {
          EXPECT_THAT(check_domain_tissue(clipped(disks_in(loops, count, 0.3 / std::sqrt(count), seed), loops), loops),
                      IsEmpty())
              << shape << " " << count << " seed " << seed;
          ++made;
        } catch (const SceneError& error) {
          ++refused;
          EXPECT_LT(count, 100) << shape << ": " << error.what();
          EXPECT_THAT(error.what(), ::testing::AnyOf(HasSubstr("holes: hole"), HasSubstr("no neighbour can take")));
        }
      }
  EXPECT_GT(made, 20 * refused) << made << " made, " << refused << " refused";
}

TEST(DomainTissue, has_in_every_point_the_piece_of_the_nearest_site) {
  for (const std::string& shape : kShapes) {
    const Loops loops = domain_of(shape);
    const auto disks = disks_in(loops, 150, 0.03, 7);
    const Tessellation tiles = tessellate(disks, box_around(loops, disks), reporting());
    const Overlay pieces = overlay(tiles, loops);
    Numbers numbers(3);
    int tested = 0;
    while (tested < 3000) {
      const double x = numbers.between(-0.1, 1.2), y = numbers.between(-0.1, 1.2);
      const auto [site, margin] = nearest_site(disks, {x, y});
      if (margin < 1e-9) continue;
      std::vector<Index> found;
      for (const Piece& piece : pieces.pieces)
        if (is_inside(polygon_of(pieces, piece), Vec2(x, y))) found.push_back(tiles.tiles[piece.tile].site);
      ++tested;
      if (!is_inside(loops, Vec2(x, y)))
        EXPECT_THAT(found, IsEmpty()) << shape;
      else
        EXPECT_EQ(found, std::vector<Index>{site}) << shape << " at " << x << ", " << y;
    }
  }
}

TEST(DomainTissue, gives_pieces_that_are_cut_off_to_neighbours_and_says_so) {
  // Two arms of a U, and one wide tile above both: the smaller of its parts goes to the tile of the arm.
  const Loops loops{{{0, 0}, {1, 0}, {1, 1}, {0.65, 1}, {0.65, 0.3}, {0.4, 0.3}, {0.4, 1}, {0, 1}}};
  const std::vector<Disk> disks{{{0.2, 0.3}, 0}, {{0.8, 0.3}, 0}, {{0.25, 0.9}, 0}};
  Notes notes;
  const DomainTissue tissue = clipped(disks, loops, notes);
  EXPECT_THAT(check_domain_tissue(tissue, loops), IsEmpty());
  EXPECT_EQ(tissue.mosaic.cells.size(), 3u);
  EXPECT_THAT(notes, Contains(HasSubstr("of site 2 to site 1")));
}

TEST(DomainTissue, of_one_site_is_the_domain) {
  for (const char* shape : {"disk", "L", "star"}) {
    const Loops loops = domain_of(shape);
    const DomainTissue tissue = clipped({{{0.2, 0.3}, 0.1}}, loops);
    EXPECT_THAT(check_domain_tissue(tissue, loops), IsEmpty()) << shape;
    EXPECT_EQ(tissue.mosaic.cells.size(), 1u);
  }
}

TEST(DomainTissue, refuses_a_hole_within_one_cell_by_name) {
  const Loops loops{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, hole(circle({0.25, 0.5}, 0.01, 8))};
  try {
    clipped({{{0.2, 0.5}, 0.1}, {{0.8, 0.5}, 0.1}}, loops);
    FAIL() << "no error";
  } catch (const SceneError& error) {
    EXPECT_THAT(error.what(), HasSubstr("sample.domain.holes[0]: lies within the cell of site 0"));
  }
}

TEST(DomainTissue, refuses_or_reports_sites_whose_tile_lies_outside) {
  const Loops loops = domain_of("square");
  std::vector<Disk> disks = disks_in(loops, 30, 0.01, 1);
  disks.push_back({{1.5, 1.5}, 0.01});
  const Tessellation tiles = tessellate(disks, box_around(loops, disks));
  Notes notes;
  EXPECT_THROW(clip_tiles(tiles, loops, {}, notes), SceneError);
  EXPECT_THAT(check_domain_tissue(clip_tiles(tiles, loops, reporting(), notes), loops), IsEmpty());
  EXPECT_THAT(notes, Contains(HasSubstr("1 sites have no cell")));
}

TEST(DomainTissue, decides_where_the_boundary_runs_through_vertices_and_along_walls) {
  const int n = 4;
  const std::vector<Disk> disks = lattice(n);
  const std::vector<Loops> degenerate{
      {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}},                          // along walls, corners on vertices
      {{{0, 0}, {1, 0}, {1, 0.5}, {0.5, 0.5}, {0.5, 1}, {0, 1}}},  // and concave
      {{{0, 0}, {1, 0}, {0.5, 1}}},                                // slanted, through vertices
      {{{0.5, 0}, {1, 0.5}, {0.5, 1}, {0, 0.5}}},                  // diagonal through vertices
      {{{0.1, 0.25}, {0.9, 0.25}, {0.9, 0.75}, {0.1, 0.75}}},      // two sides along walls
      {{{0.125, 0.25}, {0.25, 0.125}, {0.8, 0.5}, {0.25, 0.8}}},   // corners on walls
      {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {{0.25, 0.25}, {0.25, 0.75}, {0.75, 0.75}, {0.75, 0.25}}},
      {{{-0.1, -0.1}, {1.1, -0.1}, {1.1, 1.1}, {-0.1, 1.1}}, {{0.5, 0.25}, {0.25, 0.5}, {0.5, 0.75}, {0.75, 0.5}}},
  };
  for (std::size_t d = 0; d < degenerate.size(); ++d)
    for (const double weld : {0.0, 1e-6}) {
      const Loops& loops = degenerate[d];
      Tessellation tiles = tessellate(disks, box_around(loops, disks), reporting());
      // Lattices leave edges without length; without welding they are a coincidence more.
      if (weld > 0) weld_short_edges(tiles, 1e-9 / n);
      Notes notes;
      DomainTissue tissue = clip_tiles(tiles, loops, reporting(), notes);
      EXPECT_THAT(check_domain_tissue(tissue, loops), IsEmpty()) << "domain " << d << " weld " << weld;
      EXPECT_THAT(notes, Contains(HasSubstr("coincidences"))) << d;
      weld_short_edges(tissue, 1e-5 / n, notes);
      EXPECT_THAT(check_domain_tissue(tissue, loops), IsEmpty()) << "welded, domain " << d << " weld " << weld;
      for (std::size_t c = 0; c < tissue.mosaic.cells.size(); ++c) {
        const auto points = polygon_of(tissue.mosaic, tissue.mosaic.cells[c]);
        for (std::size_t k = 0; k < points.size(); ++k)
          EXPECT_GT((points[k] - points[(k + 1) % points.size()]).norm(), 1e-5 / n) << "domain " << d;
      }
    }
}

TEST(DomainTissue, of_a_square_that_a_lattice_fills_is_the_lattice) {
  const Loops loops = domain_of("square");
  Notes notes;
  DomainTissue tissue = clipped(lattice(4), loops, notes);
  weld_short_edges(tissue, 1e-6, notes);
  ASSERT_EQ(tissue.mosaic.cells.size(), 16u);
  for (const MosaicCell& cell : tissue.mosaic.cells) {
    const auto points = polygon_of(tissue.mosaic, cell);
    EXPECT_NEAR(polygon_area(points.data(), static_cast<Index>(points.size())), 1.0 / 16, 1e-8);
  }
}

TEST(DomainTissue, welds_edges_that_the_boundary_cuts_short) {
  for (const std::string& shape : kShapes) {
    const Loops loops = domain_of(shape);
    const auto disks = disks_in(loops, 400, 0.015, 5);
    Tessellation tiles = tessellate(disks, box_around(loops, disks), reporting());
    weld_short_edges(tiles, 0.05 * mean_edge_length(tiles));
    Notes notes;
    DomainTissue tissue = clip_tiles(tiles, loops, reporting(), notes);
    const double threshold = 0.05 * mean_wall_length(tissue);
    EXPECT_GT(weld_short_edges(tissue, threshold, notes), 0) << shape;
    EXPECT_THAT(check_domain_tissue(tissue, loops), IsEmpty()) << shape;
    int left = 0;
    for (const std::string& note : notes)
      if (note.find(" short edge") != std::string::npos) left = std::stoi(note);
    EXPECT_LT(left, 8) << shape;
  }
}

TEST(DomainTissue, does_not_depend_on_where_in_memory_it_is_made) {
  const Loops loops = domain_of("disk");
  const auto disks = disks_in(loops, 100, 0.02, 9);
  const Tessellation tiles = tessellate(disks, box_around(loops, disks), reporting());
  const DomainTissue tissue = clipped(disks, loops);
  std::vector<std::unique_ptr<char[]>> between;
  for (std::size_t k = 0; k < 30; ++k) {
    between.push_back(std::make_unique<char[]>(16 * (1 + k % 5)));
    EXPECT_EQ(tessellate(disks, box_around(loops, disks), reporting()).vertices, tiles.vertices);
    EXPECT_EQ(clipped(disks, loops).mosaic.vertices, tissue.mosaic.vertices);
  }
}

TEST(DomainTissue, is_the_same_bit_for_bit_when_made_again) {
  const Loops loops = domain_of("two holes");
  const auto disks = disks_in(loops, 200, 0.02, 9);
  const DomainTissue a = clipped(disks, loops), b = clipped(disks, loops);
  EXPECT_EQ(a.mosaic.vertices, b.mosaic.vertices);
  EXPECT_EQ(a.boundary, b.boundary);
}

TEST(DomainTissue, marks_the_edges_of_its_outer_loop_that_look_at_a_side_of_its_box) {
  const Loops loops{{{0, 0}, {2, 0}, {2, 1}, {0, 1}}, hole({{0.5, 0.1}, {1.5, 0.1}, {1.5, 0.9}, {0.5, 0.9}})};
  Numbers numbers(4);
  std::vector<Disk> disks;
  while (disks.size() < 40) {
    const double x = numbers.between(0, 2), y = numbers.between(0, 1);
    if (is_inside(loops, Vec2(x, y))) disks.push_back({{x, y}, 0.01});
  }
  DomainTissue tissue = clipped(disks, loops);
  mark_outer_sides(tissue);
  double left = 0, right = 0, bottom = 0, top = 0, none = 0;
  for (std::size_t c = 0; c < tissue.mosaic.cells.size(); ++c) {
    const auto points = polygon_of(tissue.mosaic, tissue.mosaic.cells[c]);
    for (std::size_t k = 0; k < points.size(); ++k) {
      if (tissue.boundary[c][k] < 0) continue;
      const double length = (points[(k + 1) % points.size()] - points[k]).norm();
      const auto bits = tissue.mosaic.cells[c].side[k];
      (bits == kLeft ? left : bits == kRight ? right : bits == kBottom ? bottom : bits == kTop ? top : none) += length;
    }
  }
  EXPECT_NEAR(left, 1, 1e-12);
  EXPECT_NEAR(right, 1, 1e-12);
  EXPECT_NEAR(bottom, 2, 1e-12);
  EXPECT_NEAR(top, 2, 1e-12);
  EXPECT_NEAR(none, 3.6, 1e-12) << "the hole, though it is near the sides";
}

}  // namespace
}  // namespace lamella
