#include "postproc/pictures.h"

#include <cairo.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "postproc/drawing/chart.h"
#include "tests/postproc/hexagons.h"

namespace lamella {
namespace {

std::size_t colours_of(const std::filesystem::path& png) {
  cairo_surface_t* surface = cairo_image_surface_create_from_png(png.c_str());
  EXPECT_EQ(cairo_surface_status(surface), CAIRO_STATUS_SUCCESS);
  const int width = cairo_image_surface_get_width(surface), height = cairo_image_surface_get_height(surface);
  const int stride = cairo_image_surface_get_stride(surface);
  const unsigned char* data = cairo_image_surface_get_data(surface);
  std::set<std::uint32_t> colours;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const unsigned char* pixel = data + y * stride + 4 * x;
      colours.insert(static_cast<std::uint32_t>(pixel[0] | pixel[1] << 8 | pixel[2] << 16));
    }
  cairo_surface_destroy(surface);
  return colours.size();
}

TEST(Pictures, snapshots_of_a_tissue_are_not_blank) {
  const Sample sample = hexagon_tissue(5, 4, 1, 3, 0.05);
  Frame frame = plain_frame(sample, sample.x, 1);
  std::vector<double> energy(sample.cells());
  for (Index c = 0; c < sample.cells(); ++c) energy[c] = 1e-9 * c;
  frame.arrays.add({"bar_energy", "J", "cell", 1, energy});
  const FrameView view(sample, frame);
  const Paths pages = draw_snapshots(fresh_folder() / "tissue", {{&view, "title", "subtitle", {}}}, std::nullopt);
  ASSERT_EQ(pages.size(), 2u);
  EXPECT_GT(colours_of(pages[0]), 100u);
  EXPECT_GT(std::filesystem::file_size(pages[1]), 1000u);
}

TEST(Pictures, an_open_chain_is_drawn_as_a_line) {
  Sample sample;
  sample.cell_begin = {0};
  add_cell(sample, {{0, 0}, {1, 0}, {2, 0}, {3, 0}}, false, 0.01, "cells");
  sample.side.assign(4, 0);
  sample.box = {Vec2(0, -1), Vec2(3, 1)};
  Frame frame;
  frame.arrays.add({"x", "m", "node", 2, std::vector<double>{0, 0, 1, 0, 2, 0, 3, 0}});
  const FrameView view(sample, frame);
  const Paths pages = draw_snapshots(fresh_folder() / "chain", {{&view, "start", "", {}}}, std::nullopt);
  EXPECT_GT(colours_of(pages[0]), 20u);
}

TEST(Charts, ticks_are_round_and_inside) {
  EXPECT_EQ(round_ticks(0, 10, 5), (std::vector<double>{0, 2, 4, 6, 8, 10}));
  for (double high : {1e-9, 0.037, 1.0, 7.3, 4.4e6}) {
    const std::vector<double> ticks = round_ticks(0, high, 6);
    EXPECT_GE(ticks.size(), 3u);
    EXPECT_LE(ticks.size(), 12u);
    EXPECT_LE(ticks.back(), high * (1 + 1e-9));
    std::set<std::string> labels;
    for (double t : ticks) labels.insert(tick_label(t, ticks));
    EXPECT_EQ(labels.size(), ticks.size()) << "labels must differ at " << high;
  }
}

TEST(Charts, units_get_a_prefix_that_keeps_numbers_short) {
  EXPECT_EQ(scaled_unit(2.5e6, "Pa").name, "MPa");
  EXPECT_EQ(scaled_unit(1000, "Pa").name, "kPa");
  EXPECT_EQ(scaled_unit(3e-9, "J").name, "nJ");
  EXPECT_DOUBLE_EQ(scaled_unit(3e-9, "J").factor, 1e-9);
  EXPECT_EQ(scaled_unit(5, "m").name, "m");
}

TEST(Charts, colours_run_from_dark_to_light_without_turning_back) {
  double before = -1;
  for (double v = 0; v <= 1; v += 0.01) {
    const Colour c = viridis(v);
    const double lightness = 0.2126 * c.red + 0.7152 * c.green + 0.0722 * c.blue;
    EXPECT_GT(lightness, before);
    before = lightness;
  }
}

}  // namespace
}  // namespace lamella
