#include "tests/postproc/hexagons.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace lamella {
namespace {

/// Nodes of neighbouring cells that face each other at 2 r, by brute force over near cells.
void link_facing(Sample& sample, double facing) {
  const std::vector<Index> cell_of = cell_of_node(sample);
  for (Index a = 0; a < sample.cells(); ++a)
    for (Index b = a + 1; b < sample.cells(); ++b) {
      std::vector<Link> links;
      for (Index i = sample.cell_begin[a]; i < sample.cell_begin[a + 1]; ++i)
        for (Index j = sample.cell_begin[b]; j < sample.cell_begin[b + 1]; ++j) {
          if (std::abs((sample.x[j] - sample.x[i]).norm() - facing) > 1e-6 * facing) continue;
          Link link;
          link.a = i, link.b = j;
          links.push_back(link);
        }
      if (links.empty()) continue;
      // In the order of a's cell; a wall over the cell's first node starts after the gap in the numbers.
      std::sort(links.begin(), links.end(), [](const Link& p, const Link& q) { return p.a < q.a; });
      for (std::size_t k = 0; k + 1 < links.size(); ++k)
        if (links[k + 1].a != links[k].a + 1) {
          std::rotate(links.begin(), links.begin() + static_cast<std::ptrdiff_t>(k) + 1, links.end());
          break;
        }
      const auto wall = static_cast<Index>(sample.walls.size());
      const std::size_t last = links.size() - 1;
      double length = 0;
      for (std::size_t k = 0; k <= last; ++k) {
        Link& link = links[k];
        link.wall = wall;
        link.wall_end = k == 0 || k == last;
        link.a_prev = k == 0 ? link.a : sample.prev(a, link.a),
        link.a_next = k == last ? link.a : sample.next(a, link.a);
        link.b_prev = k == last ? link.b : sample.prev(b, link.b),
        link.b_next = k == 0 ? link.b : sample.next(b, link.b);
        link.spacing = sample.rest_length[k == last ? sample.prev(a, link.a) : link.a];
        link.length = link.spacing * (link.wall_end ? 0.5 : 1);
        link.offset_n = facing;
        length += link.length;
        sample.links.push_back(link);
      }
      sample.walls.push_back({a, b, length});
    }
}

}  // namespace

Sample hexagon_tissue(int columns, int rows, double side, int segments, double radius) {
  Sample sample;
  sample.cell_begin = {0};
  const double width = std::sqrt(3.0) * side, inner = side - 2 * radius / std::sqrt(3.0);
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const Vec2 centre((column + (row % 2 ? 1.0 : 0.5)) * width, side + 1.5 * side * row);
      std::vector<Vec2> points;
      for (int corner = 0; corner < 6; ++corner) {
        const auto at = [&](int k) {
          return Vec2(centre + inner * Vec2(std::cos(M_PI / 6 + k * M_PI / 3), std::sin(M_PI / 6 + k * M_PI / 3)));
        };
        for (int s = 0; s < segments; ++s)
          points.push_back(at(corner) + (at(corner + 1) - at(corner)) * s / static_cast<double>(segments));
      }
      const Index c = add_cell(sample, points, true, radius, "cells");
      sample.tile_area.resize(sample.cells());
      sample.tile_area[c] = 1.5 * std::sqrt(3.0) * side * side;
    }
  sample.box = {Vec2::Zero(), Vec2((columns + (rows > 1 ? 0.5 : 0)) * width, (1.5 * rows + 0.5) * side)};
  link_facing(sample, 2 * radius);

  sample.side.assign(sample.nodes(), 0);
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const Index c = row * columns + column;
      const double half =
          0.5 * (sample.x[sample.cell_begin[c] + segments].y() + sample.x[sample.cell_begin[c] + 4 * segments].y());
      for (int k = 0; k <= 6 * segments; ++k) {
        const Index i = sample.cell_begin[c] + k % (6 * segments);
        std::uint8_t& bits = sample.side[i];
        if (row == 0 && sample.x[i].y() < half - 0.4 * side) bits |= kBottom;
        if (row == rows - 1 && sample.x[i].y() > half + 0.4 * side) bits |= kTop;
        // corners 0 and 5 bound the right wall, 2 and 3 the left one
        const int corner = (k % (6 * segments)) / segments;
        const bool at_corner = k % segments == 0;
        if (column == columns - 1 && (corner == 5 || (corner == 0 && at_corner))) bits |= kRight;
        if (column == 0 && (corner == 2 || (corner == 3 && at_corner))) bits |= kLeft;
      }
    }
  return sample;
}

Sample two_squares(double radius) {
  Sample sample;
  sample.cell_begin = {0};
  for (double x : {0.0, 1 + 2 * radius})
    add_cell(sample, {{x, 0}, {x + 1, 0}, {x + 1, 1}, {x, 1}}, true, radius, "cells");
  sample.tile_area = {1.5, 1.5};
  sample.box = {Vec2(-0.5, -0.25), Vec2(2.5 + 2 * radius, 1.25)};
  link_facing(sample, 2 * radius);
  sample.side = {kLeft, 0, 0, kLeft, 0, kRight, kRight, 0};
  return sample;
}

std::vector<Index> links_between(const Sample& sample, Index cell_a, Index cell_b) {
  std::vector<Index> found;
  for (std::size_t l = 0; l < sample.links.size(); ++l) {
    const Wall& wall = sample.walls[sample.links[l].wall];
    if (wall.cell_a == std::min(cell_a, cell_b) && wall.cell_b == std::max(cell_a, cell_b))
      found.push_back(static_cast<Index>(l));
  }
  return found;
}

Frame plain_frame(const Sample& sample, const std::vector<Vec2>& x, double time) {
  Frame frame;
  frame.time = time;
  std::vector<double> flat;
  for (const Vec2& p : x) flat.push_back(p.x()), flat.push_back(p.y());
  frame.arrays.add({"x", "m", "node", 2, std::move(flat)});
  const std::size_t links = sample.links.size();
  frame.arrays.add({"link_force", "N", "link", 2, std::vector<double>(2 * links, 0.0)});
  frame.arrays.add({"link_energy", "J", "link", 1, std::vector<double>(links, 0.0)});
  frame.arrays.add({"link_zeta", "1", "link", 1, std::vector<double>(links, -1.0)});
  frame.arrays.add({"link_damage", "1", "link", 1, std::vector<double>(links, 0.25)});
  frame.arrays.add({"link_w0", "J", "link", 1, std::vector<double>(links, 1e-9)});
  frame.arrays.add({"link_intact", "1", "link", 1, std::vector<std::int32_t>(links, 1)});
  frame.arrays.add({"link_break_time", "s", "link", 1, std::vector<double>(links, -1.0)});
  return frame;
}

void break_links(Frame& frame, const std::vector<Index>& links, double time) {
  ArraySet changed;
  for (NamedArray array : frame.arrays.all()) {
    for (Index l : links) {
      if (array.name == "link_intact") std::get<std::vector<std::int32_t>>(array.data)[l] = 0;
      if (array.name == "link_break_time") std::get<std::vector<double>>(array.data)[l] = time;
    }
    changed.add(std::move(array));
  }
  frame.arrays = std::move(changed);
}

std::filesystem::path made_up_tensile_test(const std::filesystem::path& folder, int columns, int rows, int frames) {
  constexpr double kYoung = 2e6, kPoisson = 0.3, kPeak = 0.04, kEnd = 0.06, kSide = 20e-6, kDepth = 1e-3;
  const Sample sample = hexagon_tissue(columns, rows, kSide, 4, 0.8e-6);
  const Index cut = rows / 2;  // the crack runs under this row
  const double gauge = sample.box.size().y(), width = sample.box.size().x();
  const std::filesystem::path path = folder / "trajectory.h5";
  const auto text = [](double value) { return fmt::format("{:.17g}", value); };
  TrajectoryWriter writer(path, sample,
                          {{"axis", "y"},
                           {"kind", "tension"},
                           {"gauge_length", text(gauge)},
                           {"width", text(width)},
                           {"depth", text(kDepth)},
                           {"title", "A made-up tensile test <of hexagons>"},
                           {"version", "test"}});
  writer.set_response_columns({"time", "stage", "strain", "stress", "force_a", "force_b", "energy_bars",
                               "energy_cohesive_links", "kinetic", "work", "fracture", "broken_links", "residual"},
                              {"s", "1", "1", "Pa", "N", "N", "J", "J", "J", "J", "J", "1", "1"});
  // Links under the row `cut`, from left to right.
  std::vector<Index> torn;
  for (std::size_t l = 0; l < sample.links.size(); ++l) {
    const Wall& wall = sample.walls[sample.links[l].wall];
    if (wall.cell_a / columns == cut - 1 && wall.cell_b / columns == cut) torn.push_back(static_cast<Index>(l));
  }
  std::sort(torn.begin(), torn.end(),
            [&](Index p, Index q) { return sample.x[sample.links[p].a].x() < sample.x[sample.links[q].a].x(); });
  const std::vector<Index> cell_of = cell_of_node(sample);
  std::size_t broken = 0;
  constexpr int kRows = 10;  // of the response between frames
  for (int k = 0; k < frames; ++k) {
    double time = 0;
    for (int row = 0; row < kRows; ++row) {
      const double strain = kEnd * (k * kRows + row) / ((frames - 1.0) * kRows);
      time = strain;
      // down from the peak within a tenth of its strain
      const double after = std::clamp((strain - kPeak) / (0.1 * kPeak), 0.0, 1.0);
      const double stress = strain <= kPeak ? kYoung * strain : kYoung * kPeak * (1 - after);
      const double volume = gauge * width * kDepth, stored = 0.5 * stress * stress / kYoung * volume;
      const double fracture = strain > kPeak ? 0.5 * kYoung * kPeak * kPeak * volume - stored : 0;
      const auto target = static_cast<std::size_t>(
          std::lround(torn.size() * std::clamp((strain - 0.85 * kPeak) / (0.24 * kPeak), 0.0, 1.0)));
      for (; broken < target; ++broken) {
        Event event;
        event.time = time, event.link = torn[broken], event.strain = strain, event.energy = 1e-9;
        event.position = sample.x[sample.links[torn[broken]].a];
        writer.add_event(event);
      }
      const double force = stress * width * kDepth;
      writer.add_response({time, 0, strain, stress, force, force, 0.9 * stored, 0.1 * stored, 0, stored + fracture,
                           fracture, static_cast<double>(broken), 0});
      if (row == 0) {
        std::vector<Vec2> x = sample.x;
        const double elastic = strain <= kPeak ? strain : kPeak * (1 - after);
        for (Index i = 0; i < sample.nodes(); ++i) {
          const bool above = cell_of[i] / columns >= cut;
          x[i].y() = sample.x[i].y() * (1 + elastic) + (above ? (strain - elastic) * gauge : 0);
          x[i].x() = sample.x[i].x() * (1 - kPoisson * elastic);
        }
        Frame frame = plain_frame(sample, x, time);
        frame.step = 100 * k;
        std::vector<double> energy(sample.cells());
        for (Index c = 0; c < sample.cells(); ++c) {
          const double row_distance = std::abs(static_cast<double>(c / columns) - cut + 0.5);
          energy[c] = 1e-9 * (stress / (kYoung * kPeak)) * (stress / (kYoung * kPeak)) *
                      (3 + 3 * std::exp(-row_distance) + 2 * std::sin(1.7 * c) * std::cos(0.9 * c));
        }
        frame.arrays.add({"bar_energy", "J", "cell", 1, energy});
        for (std::size_t b = 0; b < broken; ++b)
          break_links(frame, {torn[b]}, 0.85 * kPeak + 0.24 * kPeak * b / torn.size());
        writer.write_frame(frame, {});
      }
    }
  }
  writer.finish("made up");
  return path;
}

std::filesystem::path fresh_folder() {
  const auto* test = testing::UnitTest::GetInstance()->current_test_info();
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "lamella_postproc" / test->name();
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

}  // namespace lamella
