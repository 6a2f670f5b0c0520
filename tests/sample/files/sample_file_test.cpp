#include "generator/sample/sample_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <limits>
#include <random>
#include <tuple>

#include "generator/sample/errors.h"
#include "generator/sample/h5.h"
#include "tests/support/samples.h"
#include "tests/support/temporary_folder.h"

/// HDF5 itself forgets some memory when it refuses a damaged file.
extern "C" const char* __lsan_default_suppressions() { return "leak:libhdf5"; }

namespace lamella {
namespace {

using testing::HasSubstr;

class SampleFile : public testing::Test {
 protected:
  /// What reading says of two bonded squares with a fault.
  std::string fault(const std::function<void(Sample&)>& spoil) {
    Sample sample = two_bonded_squares();
    spoil(sample);
    write_sample(path_, sample);
    return message();
  }
  std::string message() {
    try {
      read_sample(path_);
    } catch (const DataError& error) {
      return error.what();
    }
    return "no DataError";
  }
  std::string bytes() {
    std::ifstream file(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_ / "sample.h5";
};

TEST_F(SampleFile, factors_on_thickness_and_strength_come_back_and_are_absent_where_nothing_varies) {
  Sample sample = two_bonded_squares();
  write_sample(path_, sample);
  EXPECT_TRUE(read_sample(path_).cell_thickness.empty());
  EXPECT_TRUE(read_sample(path_).link_strength.empty());
  EXPECT_FALSE(h5::Node::open(path_).group("cells").has("thickness"));
  EXPECT_FALSE(h5::Node::open(path_).group("links").has("strength"));
  sample.cell_thickness = {1.25, 0.1};
  for (std::size_t l = 0; l < sample.links.size(); ++l)
    sample.link_strength.push_back(1 + 0.3 * static_cast<double>(l));
  write_sample(path_, sample);
  EXPECT_EQ(read_sample(path_).cell_thickness, sample.cell_thickness);
  EXPECT_EQ(read_sample(path_).link_strength, sample.link_strength);
}

TEST_F(SampleFile, factors_that_are_none_are_refused_by_row) {
  const auto thickness = [&](std::vector<double> values) {
    return fault([&](Sample& s) { s.cell_thickness = std::move(values); });
  };
  EXPECT_THAT(thickness({1, 0}), HasSubstr("'thickness' of cell 1 is 0; must be positive"));
  EXPECT_THAT(thickness({-1, 1}), HasSubstr("'thickness' of cell 0 is -1; must be positive"));
  EXPECT_THAT(thickness({1, NAN}), HasSubstr("'thickness' of cell 1 is nan; must be a finite number"));
  EXPECT_THAT(thickness({1}), HasSubstr("'thickness' has 1 rows; must have 2, one per cell"));
  EXPECT_THAT(fault([](Sample& s) { s.link_strength.assign(s.links.size() + 1, 1.0); }), HasSubstr("'strength' has"));
  EXPECT_THAT(fault([](Sample& s) { s.link_strength.assign(s.links.size(), 1.0), s.link_strength[1] = 0; }),
              HasSubstr("'strength' of link 1 is 0; must be positive"));
}

TEST_F(SampleFile, a_sample_comes_back_as_it_was) {
  Sample sample = two_bonded_squares(40);
  add_cell(sample, {{3, 0}, {3.5, 0.1}, {4, 0}}, false, 0.02, "fibres");
  sample.rest_angle[3] = -0.1234567890123456789;
  sample.scene_text = "title = \"é\"\n";
  sample.seed = std::numeric_limits<std::uint64_t>::max();
  write_sample(path_, sample);
  const Sample read = read_sample(path_);

  EXPECT_EQ(read.box.lo, sample.box.lo);
  EXPECT_EQ(read.box.hi, sample.box.hi);
  EXPECT_EQ(read.x, sample.x);
  EXPECT_EQ(read.side, sample.side);
  EXPECT_EQ(read.rest_length, sample.rest_length);
  EXPECT_EQ(read.rest_angle, sample.rest_angle);
  EXPECT_EQ(read.hinge_length, sample.hinge_length);
  EXPECT_EQ(read.cell_begin, sample.cell_begin);
  EXPECT_EQ(read.closed, sample.closed);
  EXPECT_EQ(read.group, sample.group);
  EXPECT_EQ(read.radius, sample.radius);
  EXPECT_EQ(read.rest_area, sample.rest_area);
  EXPECT_EQ(read.tile_area, sample.tile_area);
  EXPECT_EQ(read.group_names, sample.group_names);
  EXPECT_EQ(read.scene_text, sample.scene_text);
  EXPECT_EQ(read.seed, sample.seed);
  ASSERT_EQ(read.walls.size(), sample.walls.size());
  EXPECT_EQ(read.walls[0].cell_a, 0);
  EXPECT_EQ(read.walls[0].cell_b, 1);
  EXPECT_EQ(read.walls[0].length, sample.walls[0].length);
  ASSERT_EQ(read.links.size(), sample.links.size());
  for (std::size_t l = 0; l < read.links.size(); ++l) {
    const Link &a = read.links[l], &b = sample.links[l];
    EXPECT_EQ(std::tie(a.a, a.b, a.a_prev, a.a_next, a.b_prev, a.b_next, a.wall, a.wall_end, a.length, a.spacing,
                       a.offset_n, a.offset_t),
              std::tie(b.a, b.b, b.a_prev, b.a_next, b.b_prev, b.b_next, b.wall, b.wall_end, b.length, b.spacing,
                       b.offset_n, b.offset_t));
  }
}

/// The two squares beside their own images: the box repeats along x, and each is linked to itself too.
Sample periodic_squares() {
  Sample sample = two_bonded_squares();
  sample.periodic = {true, false};
  sample.box.lo.x() = 0, sample.box.hi.x() = 1.1;
  sample.link_image.assign(sample.links.size(), Image{0, 0});
  sample.walls.push_back({1, 1, 1.0});
  for (int i = 0; i <= 4; ++i) {
    Link link;
    link.a = 16 + 4 + i, link.b = 16 + (16 - i) % 16;
    link.a_prev = i == 0 ? link.a : link.a - 1, link.a_next = i == 4 ? link.a : link.a + 1;
    link.b_next = i == 0 ? link.b : 16 + (17 - i) % 16, link.b_prev = i == 4 ? link.b : 16 + 15 - i;
    link.wall = 1, link.wall_end = i % 4 == 0;
    link.length = link.spacing = 0.25, link.offset_n = 0.1;
    sample.links.push_back(link);
    sample.link_image.push_back({1, 0});
  }
  return sample;
}

TEST_F(SampleFile, a_periodic_sample_comes_back_with_its_images) {
  const Sample sample = periodic_squares();
  write_sample(path_, sample);
  const Sample read = read_sample(path_);
  EXPECT_EQ(read.periodic, sample.periodic);
  EXPECT_EQ(read.link_image, sample.link_image);
  write_sample(path_, two_bonded_squares());
  EXPECT_EQ(read_sample(path_).periodic, (Periodic{false, false}));
  EXPECT_TRUE(read_sample(path_).link_image.empty());
  const h5::Node file = h5::Node::open(path_);
  EXPECT_FALSE(file.has("periodic"));
  EXPECT_FALSE(file.group("links").has("image"));
}

TEST_F(SampleFile, images_that_cannot_be_are_refused) {
  const auto fault = [&](const std::function<void(Sample&)>& spoil) {
    Sample sample = periodic_squares();
    spoil(sample);
    write_sample(path_, sample);
    return message();
  };
  EXPECT_EQ(fault([](Sample&) {}), "no DataError");
  EXPECT_THAT(fault([](Sample& s) {
                s.link_image[1] = {0, 1};
              }),
              HasSubstr("'image' of link 1 is 1 along y; must be 0, because the sample does not repeat there"));
  EXPECT_THAT(fault([](Sample& s) { s.link_image[1] = {100, 0}; }), HasSubstr("must be from -60 to 60"));
  EXPECT_THAT(fault([](Sample& s) { s.link_image[1] = {1, 0}; }), HasSubstr("must be the same along wall 0"));
  EXPECT_THAT(fault([](Sample& s) { s.link_image.pop_back(); }), HasSubstr("'image' has 9 rows; must have 10"));
  EXPECT_THAT(fault([](Sample& s) {
                for (std::size_t l = 5; l < 10; ++l) s.link_image[l] = {0, 0};
              }),
              HasSubstr("joins cell 1 to itself"));
  EXPECT_THAT(fault([](Sample& s) { s.periodic = {false, false}; }), HasSubstr("the first must be the lower"));
}

TEST_F(SampleFile, the_same_sample_gives_the_same_bytes) {
  write_sample(path_, two_bonded_squares());
  const std::string first = bytes();
  write_sample(path_, two_bonded_squares());
  EXPECT_EQ(bytes(), first);
}

TEST_F(SampleFile, every_invariant_is_checked_and_the_message_names_the_object) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_THAT(fault([&](Sample& s) { s.x[7].y() = nan; }),
              HasSubstr("sample.h5:/nodes: 'x' of node 7 is nan; must be a finite"));
  EXPECT_THAT(fault([&](Sample& s) { s.rest_angle[2] = infinity; }), HasSubstr("'rest_angle' of node 2 is inf"));
  EXPECT_THAT(fault([](Sample& s) { s.rest_length[5] = 0; }),
              HasSubstr("'rest_length' of node 5 is 0; must be positive"));
  EXPECT_THAT(fault([](Sample& s) { s.rest_length[5] = -1; }),
              HasSubstr("'rest_length' of node 5 is -1; must be at least 0"));
  EXPECT_THAT(fault([](Sample& s) { s.rest_length.pop_back(); }), HasSubstr("'rest_length' has 31 rows; must have 32"));
  EXPECT_THAT(fault([](Sample& s) { s.side[0] = 16; }), HasSubstr("'side' of node 0 is 16; must be from 0 to 15"));
  EXPECT_THAT(fault([](Sample& s) { s.cell_begin.back() = 31; }), HasSubstr("'begin' runs from 0 to 31"));
  EXPECT_THAT(fault([](Sample& s) { s.cell_begin = {0}; }), HasSubstr("there must be at least one cell"));
  EXPECT_THAT(fault([](Sample& s) { s.cell_begin = {0, -5, 32}; }), HasSubstr("closed cell 0 has -5 nodes"));
  EXPECT_THAT(fault([](Sample& s) {
                s.cell_begin = {0, 2, 32};
              }),
              HasSubstr("closed cell 0 has 2 nodes; must have at least 3"));
  EXPECT_THAT(fault([](Sample& s) { s.closed[1] = 2; }), HasSubstr("'closed' of cell 1 is 2"));
  EXPECT_THAT(fault([](Sample& s) { s.group[1] = 1; }),
              HasSubstr("'group' of cell 1 is 1; must be the index of one of the 1"));
  EXPECT_THAT(fault([](Sample& s) { s.radius[0] = -0.1; }), HasSubstr("'radius' of cell 0 is -0.1"));
  EXPECT_THAT(fault([](Sample& s) { s.rest_area[1] = 0; }), HasSubstr("'rest_area' of cell 1 is 0; must be positive"));
  EXPECT_THAT(fault([](Sample& s) { std::reverse(s.x.begin(), s.x.begin() + 16); }),
              HasSubstr("must run counter-clockwise"));
  EXPECT_THAT(fault([](Sample& s) { s.box.hi.x() = s.box.lo.x(); }), HasSubstr("'box' runs from"));
  EXPECT_THAT(fault([](Sample& s) {
                s.walls[0] = {1, 0, 1};
              }),
              HasSubstr("wall 0 joins cell 1 to cell 0; the first must be"));
  EXPECT_THAT(fault([](Sample& s) { s.walls[0].cell_b = 2; }), HasSubstr("'cells' of wall 0 is 2"));
  EXPECT_THAT(fault([](Sample& s) { s.links[2].b = 32; }), HasSubstr("'nodes' of link 2 is 32"));
  EXPECT_THAT(fault([](Sample& s) { s.links[2].a_prev = -1; }), HasSubstr("'tangent_a' of link 2 is -1"));
  EXPECT_THAT(fault([](Sample& s) { std::swap(s.links[1].a, s.links[1].b); }), HasSubstr("link 1 names node"));
  EXPECT_THAT(fault([](Sample& s) { s.links[3].b_next = 0; }), HasSubstr("link 3 names node 0 on its side b"));
  EXPECT_THAT(fault([](Sample& s) { s.links[0].wall = 1; }), HasSubstr("'wall' of link 0 is 1"));
  EXPECT_THAT(fault([](Sample& s) { s.links[0].length = 0; }), HasSubstr("'length' of link 0 is 0; must be positive"));
  EXPECT_THAT(fault([&](Sample& s) { s.links[4].offset_t = nan; }), HasSubstr("'offset' of link 4 is nan"));
  EXPECT_THAT(fault([](Sample& s) {
                s.walls.push_back(s.walls[0]);
                s.links[0].wall = 1;
              }),
              HasSubstr("links must be sorted by wall"));
}

TEST_F(SampleFile, files_that_are_no_samples_are_named_as_such) {
  {
    auto file = h5::Node::create(path_);
    file.close();
  }
  EXPECT_THAT(message(), HasSubstr("is not a sample"));
  {
    auto file = h5::Node::create(path_);
    file.write_text("format", "lamella sample 2");
    file.close();
  }
  EXPECT_THAT(message(), HasSubstr("is of the format 'lamella sample 2'; must be 'lamella sample 1'"));
}

TEST_F(SampleFile, no_truncated_file_is_taken_for_a_sample) {
  write_sample(path_, two_bonded_squares(100));
  const std::string whole = bytes();
  for (int part = 0; part < 50; ++part) {
    std::ofstream(path_, std::ios::binary | std::ios::trunc) << whole.substr(0, whole.size() * part / 50);
    EXPECT_NE(message(), "no DataError") << "cut at " << part << "/50";
  }
}

TEST_F(SampleFile, damaged_bytes_are_refused_or_do_no_harm) {
  write_sample(path_, two_bonded_squares(100));
  const std::string whole = bytes();
  std::mt19937 random(1);
  int refused = 0;
  const int trials = 500;
  for (int trial = 0; trial < trials; ++trial) {
    std::string damaged = whole;
    for (int i = 0; i < 8; ++i) damaged[random() % damaged.size()] = static_cast<char>(random());
    std::ofstream(path_, std::ios::binary | std::ios::trunc) << damaged;
    refused += message() != "no DataError";
  }
  EXPECT_GT(refused, trials / 2);  // the rest hit unused bytes or changed a number into another
}

TEST_F(SampleFile, noise_is_refused) {
  std::mt19937 random(2);
  for (int trial = 0; trial < 100; ++trial) {
    std::string noise(random() % 5000, '\0');
    for (auto& byte : noise) byte = static_cast<char>(random());
    if (trial % 2) noise.replace(0, std::min<std::size_t>(8, noise.size()), "\x89HDF\r\n\x1a\n");
    std::ofstream(path_, std::ios::binary | std::ios::trunc) << noise;
    EXPECT_NE(message(), "no DataError");
  }
}

/// The examples of docs/formats.md, as they stand there: the first reads a sample, the second makes one.
std::vector<std::string> python_examples() {
  std::ifstream page(LAMELLA_SOURCE_DIR "/docs/formats.md");
  std::vector<std::string> examples;
  bool inside = false;
  for (std::string line; std::getline(page, line);) {
    if (line == "```python") examples.emplace_back();
    if (inside && line != "```") examples.back() += line + "\n";
    inside = line == "```python" || (inside && line != "```");
  }
  return examples;
}

TEST_F(SampleFile, a_sample_made_with_h5py_as_documented_is_read) {
  if (std::system("/usr/bin/python3 -c 'import h5py' > /dev/null 2>&1") != 0) GTEST_SKIP() << "h5py is not installed";
  const auto examples = python_examples();
  ASSERT_GE(examples.size(), 2u);
  std::ofstream(folder_ / "make.py") << examples[1];
  ASSERT_EQ(std::system(("cd " + folder_.path().string() + " && /usr/bin/python3 make.py").c_str()), 0);
  const Sample sample = read_sample(path_);
  const Sample expected = two_bonded_squares();
  EXPECT_EQ(sample.x, expected.x);
  EXPECT_EQ(sample.side, expected.side);
  EXPECT_EQ(sample.cell_begin, expected.cell_begin);
  EXPECT_THAT(sample.rest_angle, testing::Pointwise(testing::DoubleNear(1e-12), expected.rest_angle));
  EXPECT_THAT(sample.hinge_length, testing::Pointwise(testing::DoubleNear(1e-12), expected.hinge_length));
  ASSERT_EQ(sample.links.size(), expected.links.size());
  for (std::size_t l = 0; l < sample.links.size(); ++l) {
    const Link &a = sample.links[l], &b = expected.links[l];
    EXPECT_EQ(std::tie(a.a, a.b, a.a_prev, a.a_next, a.b_prev, a.b_next, a.wall, a.wall_end, a.length, a.spacing),
              std::tie(b.a, b.b, b.a_prev, b.a_next, b.b_prev, b.b_next, b.wall, b.wall_end, b.length, b.spacing));
    EXPECT_NEAR(a.offset_n, b.offset_n, 1e-15);
  }
}

TEST_F(SampleFile, a_sample_is_read_with_h5py_as_documented) {
  if (std::system("/usr/bin/python3 -c 'import h5py' > /dev/null 2>&1") != 0) GTEST_SKIP() << "h5py is not installed";
  const auto examples = python_examples();
  ASSERT_GE(examples.size(), 2u);
  write_sample(path_, two_bonded_squares());
  std::ofstream(folder_ / "plot.py") << examples[0];
  ASSERT_EQ(std::system(("cd " + folder_.path().string() + " && /usr/bin/python3 plot.py").c_str()), 0);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "cells.svg"));
}

}  // namespace
}  // namespace lamella
