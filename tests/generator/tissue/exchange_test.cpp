// Mosaics to other programs' files and back.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "generator/packing/tess_file.h"
#include "generator/sample/errors.h"
#include "generator/sample/sample_file.h"
#include "generator/tissue/mosaic_file.h"
#include "generator/tissue/mosaic_text.h"
#include "generator/tissue/polygons.h"
#include "tests/generator/tissue/mosaics.h"
#include "tests/support/messages.h"
#include "tests/support/samples.h"
#include "tests/support/temporary_folder.h"

namespace lamella {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

Mosaic read_back(const std::filesystem::path& path) {
  Notes notes;
  return share_walls(read_polygons(path, 1, notes), {}, path.string());
}

/// Same cells over the same vertices, to the last bit.
void expect_identical(const Mosaic& a, const Mosaic& b) {
  EXPECT_EQ(a.vertices, b.vertices);
  ASSERT_EQ(a.cells.size(), b.cells.size());
  for (std::size_t c = 0; c < a.cells.size(); ++c) {
    EXPECT_EQ(a.cells[c].vertex, b.cells[c].vertex) << c;
    EXPECT_EQ(a.cells[c].side, b.cells[c].side) << c;
  }
}

class Exchange : public testing::Test {
 protected:
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder / name) << text;
    return folder / name;
  }
  std::string fault(const std::string& name, const std::string& text) const {
    try {
      read_back(write(name, text));
    } catch (const SceneError& error) {
      return error.what();
    }
    return "no fault";
  }
  TemporaryFolder folder;
  // Coordinates far from round, so that a digit lost is a digit seen.
  const Mosaic tissue = voronoi(60, 3, 0.05);
};

TEST_F(Exchange, through_tess_keeps_topology_and_every_bit) {
  expect_identical(tissue, read_back(write("a.tess", tess_text(tissue))));
}

TEST_F(Exchange, through_off_keeps_topology_and_every_bit) {
  expect_identical(tissue, read_back(write("a.off", off_text(tissue))));
}

TEST_F(Exchange, through_text_keeps_topology_and_every_coordinate) {
  // Vertices are numbered as they are met, so cells are compared by their corners.
  const Mosaic back = read_back(write("a.txt", polygons_text(tissue)));
  ASSERT_EQ(back.cells.size(), tissue.cells.size());
  EXPECT_EQ(back.vertices.size(), tissue.vertices.size());
  for (std::size_t c = 0; c < back.cells.size(); ++c) {
    EXPECT_EQ(polygon_of(back, back.cells[c]), polygon_of(tissue, tissue.cells[c]));
    EXPECT_EQ(back.cells[c].side, tissue.cells[c].side);
  }
}

TEST_F(Exchange, of_corners_closer_than_any_weld_stays_exact_where_vertices_are_numbered) {
  // Two squares whose common wall is divided by a vertex a millionth from its end.
  Mosaic mosaic;
  mosaic.vertices = {{0, 0}, {1, 0}, {2, 0}, {2, 1}, {1, 1}, {0, 1}, {1, 1e-6}};
  mosaic.cells.resize(2);
  mosaic.cells[0].vertex = {0, 1, 6, 4, 5};
  mosaic.cells[1].vertex = {1, 2, 3, 4, 6};
  for (const auto& [name, text] : {std::pair{"a.tess", tess_text(mosaic)}, std::pair{"a.off", off_text(mosaic)}}) {
    const Mosaic back = read_back(write(name, text));
    EXPECT_EQ(back.vertices, mosaic.vertices);
    EXPECT_EQ(back.cells[1].vertex, mosaic.cells[1].vertex);
  }
}

TEST_F(Exchange, carries_seeds_and_the_domain_of_a_filled_box) {
  const Mosaic two = squares(2, 1);
  const std::string text = tess_text(two, {{{0.5, 0.5}, 0.25}, {{1.5, 0.5}, 0.125}});
  EXPECT_THAT(text, HasSubstr("**domain"));
  const Packing packing = read_tess_seeds(write("a.tess", text));
  EXPECT_EQ(packing.disks[1].radius, 0.125);
  EXPECT_EQ(packing.box.hi, Vec2(2, 1));
  Mosaic holed = squares(3, 3);
  holed.cells.erase(holed.cells.begin() + 4);
  EXPECT_THAT(tess_text(holed), testing::Not(HasSubstr("**domain"))) << "no rectangle";
}

TEST_F(Exchange, divides_a_wall_at_a_vertex_that_lies_on_it) {
  // One brick under two: the upper wall of the first is two walls.
  const std::string off =
      "OFF\n8 3 0\n0 0 0\n2 0 0\n2 1 0\n0 1 0\n1 1 0\n2 2 0\n1 2 0\n0 2 0\n"
      "4 0 1 2 3\n4 3 4 6 7\n4 4 2 5 6\n";
  const Mosaic mosaic = read_back(write("bricks.off", off));
  EXPECT_EQ(mosaic.cells[0].vertex.size(), 5u);
  int shared = 0;
  for (const auto& cell : opposite_edges(mosaic))
    for (const EdgePlace& edge : cell) shared += edge.cell >= 0;
  EXPECT_EQ(shared, 2 * 3);
}

TEST_F(Exchange, of_off_polygons_that_share_no_vertex_goes_by_place) {
  const Mosaic mosaic =
      read_back(write("two.off",
                      "OFF # two squares\n8 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n1 0 0\n2 0 0\n2 1 0\n1 1 0\n"
                      "4 0 1 2 3 255 0 0\n4 7 6 5 4 0 0 255\n"));  // the second runs clockwise
  EXPECT_EQ(mosaic.vertices.size(), 6u);
  EXPECT_EQ(opposite_edges(mosaic)[0][1].cell, 1);
}

TEST_F(Exchange, refuses_off_files_with_line_and_remedy) {
  const std::string head = "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
  EXPECT_THAT(fault("a.off", "COFF\n"), HasSubstr("a.off:1: an .off file begins with OFF"));
  EXPECT_THAT(fault("a.off", ""), HasSubstr("a.off:1: the file ends where OFF should be"));
  EXPECT_THAT(fault("a.off", head), HasSubstr("the file ends where the number of the face's vertices"));
  EXPECT_THAT(fault("a.off", head + "4 0 1 2 4\n"), HasSubstr("a.off:7: a face's vertex is 4; must be from 0 to 3"));
  EXPECT_THAT(fault("a.off", head + "4 0 1 2 -1\n"), HasSubstr("a.off:7: a face's vertex is -1"));
  EXPECT_THAT(fault("a.off", head + "4 0 1 2 2\n"), HasSubstr("a.off:7: the face has vertex 2 twice"));
  EXPECT_THAT(fault("a.off", head + "2 0 1\n"), HasSubstr("a.off:7: a face of 2 vertices"));
  EXPECT_THAT(fault("a.off", head + "4 0 1 2 3\n4 0 1 2 3\n"), HasSubstr("a.off:8: more than the 1 faces"));
  EXPECT_THAT(fault("a.off", head + "4 0 2 1 3\n"), AllOf(HasSubstr("a.off:7: cell 0"), HasSubstr("encloses no area")));
  EXPECT_THAT(fault("a.off", "OFF\n4000000000 1 0\n"), HasSubstr("must be from 0 to"));
  EXPECT_THAT(fault("a.off", "OFF\n2000000000 1 0\n"), HasSubstr("the rest of the file can hold"));
  EXPECT_THAT(fault("a.off", "OFF\n4 1 0\n0 0 1\n"), HasSubstr("a.off:3: z is 1; must be 0"));
  EXPECT_THAT(fault("a.off", "OFF\n4 1 0\n0 inf 0\n"), HasSubstr("a.off:3: y is inf; must be finite"));
}

TEST_F(Exchange, refuses_tess_cells_that_overlap) {
  Mosaic mosaic;
  mosaic.vertices = {{0, 0}, {2, 0}, {2, 1}, {0, 1}, {1, 0}, {3, 0}, {3, 1}, {1, 1}};
  mosaic.cells.resize(2);
  mosaic.cells[0].vertex = {0, 1, 2, 3};
  mosaic.cells[1].vertex = {4, 5, 6, 7};
  EXPECT_THAT(fault("a.tess", tess_text(mosaic)), HasSubstr("overlaps"));
}

TEST_F(Exchange, writes_periodic_cells_whole) {
  Mosaic torus = squares(1, 1);
  torus.periodic = {true, true};
  torus.vertices = {{0, 0}};
  torus.cells[0].vertex = {0, 0, 0, 0};
  torus.cells[0].image = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const PlainMosaic plain = in_one_piece(torus);
  EXPECT_EQ(plain.vertices, (std::vector<Vec2>{{0, 0}, {1, 0}, {1, 1}, {0, 1}}));
  EXPECT_EQ(plain.cells, (std::vector<std::vector<Index>>{{0, 1, 2, 3}}));
}

TEST_F(Exchange, with_a_samples_file_keeps_its_tiles_to_the_last_bit) {
  Mosaic tiles = tissue;
  tiles.cells[3].group = "stiff";
  const Sample sample = two_bonded_squares();
  write_sample(folder / "sample.h5", sample, tiles);
  const auto back = read_tiles(folder / "sample.h5");
  ASSERT_TRUE(back);
  expect_identical(tiles, *back);
  EXPECT_EQ(back->cells[3].group, "stiff");
  EXPECT_EQ(back->box.hi, sample.box.hi);
  EXPECT_EQ(read_sample(folder / "sample.h5").x, sample.x) << "a sample like any other";
  write_sample(folder / "plain.h5", sample);
  EXPECT_FALSE(read_tiles(folder / "plain.h5"));
}

TEST_F(Exchange, refuses_tiles_that_do_not_fit_together) {
  const auto message = [&](const std::function<void(h5::Node&)>& fill) {
    h5::replace_file(folder / "broken.h5", [&](h5::Node& file) {
      write_sample(file, two_bonded_squares());
      h5::Node tiles = file.make_group("tiles");
      fill(tiles);
      tiles.write_texts("groups", {"cells"});
      tiles.write_text("periodic", "");
    });
    return message_of([&] { read_tiles(folder / "broken.h5"); });
  };
  const auto with = [](std::vector<Index> begin, std::vector<Index> vertex, double x, Index group) {
    return [=](h5::Node& tiles) {
      tiles.write("x", std::vector<double>{0, 0, x, 0, 0, 1}, 2);
      tiles.write("begin", begin);
      tiles.write("vertex", vertex);
      tiles.write("side", std::vector<std::uint8_t>(vertex.size(), 0));
      tiles.write("group", std::vector<Index>{group});
    };
  };
  EXPECT_EQ(message(with({0, 3}, {0, 1, 2}, 1, 0)), "no DataError");
  EXPECT_THAT(message(with({0, 4}, {0, 1, 2}, 1, 0)), HasSubstr("'begin' does not divide the 3 rows"));
  EXPECT_THAT(message(with({0, 2}, {0, 1}, 1, 0)), HasSubstr("tile 0 has fewer than 3 corners"));
  EXPECT_THAT(message(with({0, 3}, {0, 1, 3}, 1, 0)), HasSubstr("'vertex' names 3; there are 3 vertices"));
  EXPECT_THAT(message(with({0, 3}, {0, 1, -1}, 1, 0)), HasSubstr("'vertex' names -1"));
  EXPECT_THAT(message(with({0, 3}, {0, 1, 2}, std::nan(""), 0)), HasSubstr("'x' of vertex 1 is not finite"));
  EXPECT_THAT(message(with({0, 3}, {0, 1, 2}, 1, 1)), HasSubstr("'group' of tile 0 is 1"));
}

}  // namespace
}  // namespace lamella
