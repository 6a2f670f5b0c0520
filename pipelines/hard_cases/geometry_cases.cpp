// What the generator makes of awkward input (edges of almost no length, four cells at a point, sizes of ten to one), and what the search for
// contacts and the time step make of that.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <set>

#include "generator/generate.h"
#include "generator/packing/laguerre.h"
#include "generator/packing/packing_file.h"
#include "generator/sample/errors.h"
#include "pipelines/hard_cases/hard_cases.h"
#include "pipelines/hard_cases/tools.h"
#include "simulator/contact/overlap.h"
#include "simulator/steppers/stable_time_step.h"

namespace lamella::hard_cases {
namespace {

/// An edge between two tiles, inside the box: the sites on its two sides, and those at its two ends.
struct Edge {
  double length = 0;
  Index left = 0, right = 0, begin = 0, end = 0;
};

std::vector<Edge> inner_edges(const Tessellation& t) {
  std::vector<Edge> out;
  for (const Tile& tile : t.tiles) {
    const std::size_t n = tile.vertex.size();
    for (std::size_t k = 0; k < n; ++k) {
      const Index across = tile.neighbour[k], before = tile.neighbour[(k + n - 1) % n],
                  after = tile.neighbour[(k + 1) % n];
      if (across < tile.site || before < 0 || after < 0) continue;
      out.push_back({edge_length(t, tile, k), tile.site, across, before, after});
    }
  }
  return out;
}

/// Length of the edge between two sites; minus that between the sites at its ends once these have become neighbours instead.
double signed_length(const std::vector<Disk>& disks, const Box& box, const Edge& edge) {
  const auto sides = [&](const Edge& e, Index a, Index b) {
    return (e.left == a && e.right == b) || (e.left == b && e.right == a);
  };
  for (const Edge& e : inner_edges(tessellate(disks, box))) {
    if (sides(e, edge.left, edge.right)) return e.length;
    if (sides(e, edge.begin, edge.end)) return -e.length;
  }
  return 0;
}

/// Moves the site at one end of the edge along it until the edge has this (signed) length [m].
void set_edge(std::vector<Disk>& disks, const Box& box, const Edge& edge, double length) {
  const Vec2 from = disks[edge.begin].centre, way = disks[edge.end].centre - from;
  double low = 0, high = 0.3;  // of the way: the edge shrinks as the sites at its ends come near each other
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    disks[edge.begin].centre = from + middle * way;
    (signed_length(disks, box, edge) > length ? low : high) = middle;
  }
}

/// A scene whose sites are those of a file in the study's folder of results.
Scene scene_of_sites(StudyBench& bench, const std::string& scene, const std::string& name, const Box& box,
                     const std::vector<Disk>& disks, std::vector<std::string> settings = {}) {
  Packing packing;
  packing.box = box, packing.disks = disks;
  const auto path = std::filesystem::absolute(bench.out() / (name + ".csv"));
  write_packing(path, packing);
  settings.push_back(fmt::format("sample.packing.file=\"{}\"", path.string()));
  return bench.scene(scene, settings);
}

}  // namespace

void tiny_edges(StudyBench& bench) {
  StudyReport& report = bench.report;
  report.section("Tiny edges");
  report.text(
      "A tissue in which one site is moved until an edge is 0.001 of the mean edge. The generator welds edges below "
      "walls.weld (0.05) and merges "
      "mass points nearer\nthan a quarter of the spacing, so that none of this reaches the simulator; a sample from "
      "elsewhere may bring it.");
  const Scene base = bench.scene("tissue.toml");
  const Packing packing = make_packing(base);
  std::vector<Disk> disks = packing.disks;
  const Tessellation tessellation = tessellate(disks, packing.box);
  const auto edges = inner_edges(tessellation);
  const Edge shortest =
      *std::min_element(edges.begin(), edges.end(), [](auto& a, auto& b) { return a.length < b.length; });
  const double mean = mean_edge_length(tessellation);
  set_edge(disks, packing.box, shortest, 1e-3 * mean);
  report.compare("length of the edge over the mean edge", signed_length(disks, packing.box, shortest) / mean, 1e-3,
                 1e-6);

  const Scene kept_scene =
      scene_of_sites(bench, "tissue.toml", "tiny_edge", packing.box, disks, {"sample.walls.weld=0"});
  const Scene weld_scene = scene_of_sites(bench, "tissue.toml", "tiny_edge", packing.box, disks);
  const Sample kept = sample_of(kept_scene), welded = sample_of(weld_scene);
  const Tension with = pull_statically(kept, kept_scene.stages[0]),
                without = pull_statically(welded, weld_scene.stages[0]);
  report.compare("E*, edge kept by the generator, over that of the edge welded", with.modulus / without.modulus, 1,
                 0.01);
  report.compare("first-break load, likewise", with.first_break / without.first_break, 1, 0.01);

  report.text(
      "The same tissue with a segment of 0.001 spacings behind the first node of every cell, as a sample from "
      "elsewhere might hold it.");
  const double tiny =
      1e-3 * std::accumulate(welded.rest_length.begin(), welded.rest_length.end(), 0.0) / welded.nodes();
  const Sample split = with_tiny_segments(welded, tiny);
  report.holds("the sample with tiny segments is sound", check_sample(split).empty(),
               fmt::format("{} nodes, shortest segment {:.2g}", split.nodes(),
                           *std::min_element(split.rest_length.begin(), split.rest_length.end())));
  const Tension tiny_answer = pull_statically(split, weld_scene.stages[0]);
  report.compare("E* with tiny segments, over that without", tiny_answer.modulus / without.modulus, 1, 0.01);
  report.compare("first-break load, likewise", tiny_answer.first_break / without.first_break, 1, 0.01);

  // A hundred thousand steps of a shaken piece of it.
  const Scene few = bench.scene("tissue.toml", {"sample.packing.count=6", "sample.packing.fraction=0.6",
                                                "sample.width=2.6", "sample.height=2.6"});
  const Sample plain_piece = sample_of(few), piece = with_tiny_segments(plain_piece, tiny);
  Stage stage = few.stages[0];
  stage.loading.reset(), stage.drag.reset(), stage.contact.reset();
  stage.links["links"].normal_strength.reset(), stage.links["links"].tangential_strength.reset();
  Rig plain(plain_piece, stage), rig(piece, stage);
  const StableStep limit = stable_time_step(*rig.model, rig.state.x, rig.stepper.fully_held());
  std::string said;
  Scene with_time = few;
  with_time.stages[0] = stage, with_time.stages[0].stop.time = 1;
  for (const std::string& line : start_up_summary(piece, with_time))
    if (line.find("set by node") != std::string::npos) said = line.substr(line.find("time step"));
  const Index before = piece.prev(cell_of_node(piece)[limit.node], limit.node);
  const bool named = said.find(fmt::format("node {} ", limit.node)) != std::string::npos &&
                     std::min(piece.rest_length[limit.node], piece.rest_length[before]) < 1.01 * tiny;
  report.holds(fmt::format("the stable step is {:.0f} times smaller than without them: said before the start, with a "
                           "node of one of them",
                           plain.stable_step() / limit.dt),
               named, said);
  std::mt19937 random(4);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (Index i = 0; i < piece.nodes(); ++i) rig.state.v.set(i, 1e-3 * Vec2(uniform(random), uniform(random)));
  const double dt = 0.5 * limit.dt;
  const int steps = 100000, every = 1000;
  std::vector<double> at, energy;
  double swing = 0;
  for (int n = 0; n <= steps; ++n) {
    if (n % every != 0) {
      rig.stepper.step(dt, dt);
      continue;
    }
    const double stored = rig.stored();
    at.push_back(n), energy.push_back(stored + rig.stepper.measured_step(dt, dt, nullptr).kinetic);
    swing = std::max(swing, std::abs(energy.back() / energy.front() - 1));
  }
  report.at_most("energy drift over 1e5 steps of a shaken piece, relative (the straight line through the energies)",
                 std::abs(slope_of(at, energy, 0, steps)) * steps / energy.front(), 1e-6);
  report.at_most("largest change of its energy, relative: of second order in the step, and comes back", swing, 1e-5);
  report.holds("all positions are numbers", std::isfinite(rig.stored()), fmt::format("after {} steps", steps));
}

void four_valent_junctions(StudyBench& bench) {
  StudyReport& report = bench.report;
  report.section("Four cells at a point");
  report.text(
      "Sites on a square lattice: every inner junction is cocircular. Predicates are exact, short edges are welded, "
      "and a link counts with the length of "
      "wall that it\nstands for.");
  const int n = 5;
  const Box box{Vec2::Zero(), Vec2::Constant(n)};
  std::vector<Disk> lattice;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) lattice.push_back({Vec2(i + 0.5, j + 0.5), 0.4});
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  double area_error = 0, modulus = 0, modulus_change = 0, peak = 0, peak_change = 0;
  std::vector<std::string> faults;
  const int trials = bench.small() ? 3 : 8;
  std::vector<Panel> panels;
  std::optional<StudyRun> shown;
  for (int trial = 0; trial <= trials; ++trial) {
    auto disks = lattice;
    if (trial > 0)
      for (Disk& d : disks) d.centre += 1e-9 * Vec2(uniform(random), uniform(random));
    const Tessellation t = tessellate(disks, box);
    for (const std::string& fault : check_tessellation(t)) faults.push_back(fault);
    double sum = 0;
    for (const Tile& tile : t.tiles) sum += tile_area(t, tile);
    area_error = std::max(area_error, std::abs(sum / box.area() - 1));
    // unwelded, too: then edges of 1e-9 are walls like all others
    const std::vector<std::string> settings{"sample.width=5", "sample.height=5",
                                            fmt::format("sample.walls.weld={}", trial % 2 == 0 ? 0.05 : 0)};
    const Scene scene = scene_of_sites(bench, "tissue.toml", fmt::format("lattice_{}", trial), box, disks, settings);
    const Sample sample = sample_of(scene);
    for (const std::string& fault : check_sample(sample)) faults.push_back(fault);
    std::set<std::pair<Index, Index>> joined;
    for (const Link& l : sample.links)
      if (!joined.emplace(l.a, l.b).second)
        faults.push_back(fmt::format("two links between nodes {} and {}", l.a, l.b));
    const double e = pull_statically(sample, scene.stages[0]).modulus;
    StudyRun run = bench.run(fmt::format("lattice_{}", trial), sample, scene);
    const auto stress = run.column("stress");
    const double p = *std::max_element(stress.begin(), stress.end());
    if (trial == 0) modulus = e, peak = p, shown.emplace(std::move(run));
    modulus_change = std::max(modulus_change, std::abs(e / modulus - 1));
    peak_change = std::max(peak_change, std::abs(p / peak - 1));
  }
  report.at_most("sum of the cells' areas, off that of the box, relative", area_error, 1e-12);
  report.holds("no dangling, double or crossing link, wall or cell", faults.empty(),
               faults.empty() ? fmt::format("{} samples", trials + 1) : faults.front());
  report.at_most("E*: change when sites move by 1e-9, relative", modulus_change, 1e-3);
  report.at_most("peak stress: change when sites move by 1e-9, relative", peak_change, 0.05);

  report.text(
      "One junction is driven through the exchange of neighbours: its edge shrinks to nothing and another one, across "
      "it, grows. Unwelded, the links of the "
      "short wall\ncount with its length; below 0.05 spacings it has none.");
  const auto edges = inner_edges(tessellate(lattice, box));
  Edge middle;
  double nearest = 1e300;
  auto disks = lattice;
  for (std::size_t k = 0; k < disks.size(); ++k) disks[k].centre.x() += 0.05 * disks[k].centre.y();  // no symmetry
  for (const Edge& e : inner_edges(tessellate(disks, box))) {
    const Vec2 at = 0.5 * (disks[e.left].centre + disks[e.right].centre);
    if (e.length < 0.3 && (at - box.hi / 2).norm() < nearest) nearest = (at - box.hi / 2).norm(), middle = e;
  }
  ReportTable table{{"length of the edge", "sum of its links' lengths", "E*"}, {}};
  std::vector<double> lengths, moduli;
  double longer = 0;
  for (const double length : {0.03, 0.01, 0.003, 0.001, 1e-6, -1e-6, -0.001, -0.003, -0.01, -0.03}) {
    auto moved = disks;
    set_edge(moved, box, middle, length);
    const Scene scene = scene_of_sites(bench, "tissue.toml", fmt::format("exchange_{:g}", length), box, moved,
                                       {"sample.width=5", "sample.height=5", "sample.walls.weld=0"});
    const Sample sample = sample_of(scene);
    double sum = 0;
    for (const Link& l : sample.links)
      if (sample.walls[l.wall].length < 0.04) sum += l.length;
    longer = std::max(longer, sum / std::abs(length));
    lengths.push_back(length), moduli.push_back(pull_statically(sample, scene.stages[0]).modulus);
    table.rows.push_back(
        {fmt::format("{:g}", length), fmt::format("{:.3g}", sum), fmt::format("{:.5f}", moduli.back())});
  }
  report.table(table);
  report.at_most("links of a short wall: their length over its own", longer, 1);
  report.at_most("E* just before and just after the exchange, relative difference", std::abs(moduli[5] / moduli[4] - 1),
                 1e-3);
  draw_panels(bench, "four_valent", "A square lattice of cells before and after it was torn.",
              {{&shown->reader.sample(), shown->positions(0), "at rest", {}},
               {&shown->reader.sample(), shown->positions(-1), "torn", {}}});
}

namespace {

/// Energy of contact by looking at every node and every cell; friction apart. Counts feet that press.
struct BruteForce {
  double energy = 0;
  Index pressing = 0;
};
BruteForce brute_force(const Sample& s, const Field& x, const std::vector<double>& node_stiffness) {
  const SelfReach self(s);
  const auto cell_of = cell_of_node(s);
  BruteForce out;
  for (Index i = 0; i < s.nodes(); ++i)
    for (Index c = 0; c < s.cells(); ++c) {
      std::vector<Index> segments;
      for (Index k = s.cell_begin[c]; k < s.cell_begin[c + 1]; ++k)
        if (c != cell_of[i] || !self.ignores(s, nullptr, c, i, k)) segments.push_back(k);
      const double reach = s.radius[c] + s.radius[cell_of[i]];
      const Feet feet = find_feet(s, x, i, c, segments, reach);
      if (feet.count == 0) continue;
      const Overlap o = overlap(feet, reach);
      out.energy += 0.5 * node_stiffness[i] * o.energy;
      for (int f = 0; f < feet.count; ++f) out.pressing += o.lambda[f] > 0;
    }
  return out;
}

/// The model's own contacts at its present list.
BruteForce listed(const Rig& rig) {
  ArraySet frame;
  rig.model->contacts->add_output(rig.state.x, frame);
  return {rig.model->contacts->energy(rig.state.x), static_cast<Index>(frame.ints("contact_node").size())};
}

}  // namespace

void high_polydispersity(StudyBench& bench) {
  StudyReport& report = bench.report;
  report.section("Sizes of ten to one");
  const Scene scene = bench.scene("ten_to_one.toml");
  const Sample tissue = sample_of(scene);
  double sum = 0;
  std::vector<double> perimeter, nodes;
  for (Index c = 0; c < tissue.cells(); ++c) {
    sum += tissue.tile_area[c];
    double p = 0;
    for (Index i = tissue.cell_begin[c]; i < tissue.cell_begin[c + 1]; ++i) p += tissue.rest_length[i];
    perimeter.push_back(p), nodes.push_back(tissue.cell_size(c));
  }
  report.at_most("tissue of 200 cells: sum of the areas, off that of the box, relative",
                 std::abs(sum / tissue.box.area() - 1), 1e-12);
  const auto mean = [](const std::vector<double>& v) {
    return std::accumulate(v.begin(), v.end(), 0.0) / static_cast<double>(v.size());
  };
  const double mp = mean(perimeter), mn = mean(nodes);
  double pp = 0, nn = 0, pn = 0;
  for (std::size_t c = 0; c < nodes.size(); ++c) {
    pp += (perimeter[c] - mp) * (perimeter[c] - mp), nn += (nodes[c] - mn) * (nodes[c] - mn);
    pn += (perimeter[c] - mp) * (nodes[c] - mn);
  }
  report.at_least("number of mass points and perimeter: correlation", pn / std::sqrt(pp * nn), 0.95);

  // A small disk in the shadow of a large one has no cell.
  const Box box{Vec2::Zero(), Vec2(6, 6)};
  std::vector<Disk> disks{{{3, 3}, 2}, {{3, 4}, 0.2}};
  for (const double x : {0.5, 5.5})
    for (const double y : {0.5, 3.0, 5.5}) disks.push_back({{x, y}, 0.5});
  disks.push_back({{3, 0.5}, 0.5}), disks.push_back({{3, 5.5}, 0.5});
  const Scene refused = scene_of_sites(bench, "tissue.toml", "hidden", box, disks);
  std::string said = "it was not refused";
  try {
    sample_of(refused);
  } catch (const SceneError& error) {
    said = error.what();
  }
  report.holds("a hidden site is refused by name",
               said.find("disk 1 ") != std::string::npos && said.find("hide it") != std::string::npos, said);
  const Scene dropped =
      scene_of_sites(bench, "tissue.toml", "hidden", box, disks, {"sample.packing.duplicates=\"keep_first\""});
  Notes notes;
  const Sample rest = generate(dropped, notes);
  std::string noted = "nothing is said";
  for (const std::string& note : notes)
    if (note.find("have no cell") != std::string::npos) noted = note;
  report.holds("or dropped and reported, where the scene says so",
               noted.find("site 1") != std::string::npos && rest.cells() == 9, noted);

  report.text(
      "200 rings of ten to one, pressed into each other: contacts found by the list against those by looking at all "
      "nodes and all cells.");
  const Scene rings_scene = bench.scene("ten_to_one_rings.toml");
  Sample rings = sample_of(rings_scene);
  for (Vec2& p : rings.x) p *= 0.985;  // rest lengths stay: they push each other apart again
  Rig rig(rings, rings_scene.stages[0]);
  std::vector<double> stiffness;
  const double kappa = *rings_scene.stages[0].contact->normal_stiffness;
  const auto cell_of = cell_of_node(rings);
  for (Index i = 0; i < rings.nodes(); ++i)
    stiffness.push_back(0.5 * kappa * (rings.rest_length[i] + rings.rest_length[rings.prev(cell_of[i], i)]));
  const StableStep limit = stable_time_step(*rig.model, rig.state.x, rig.stepper.fully_held());
  const double smallest = *std::min_element(rings.rest_area.begin(), rings.rest_area.end());
  report.at_most("area of the cell that sets the time step, over the smallest",
                 rings.rest_area[cell_of[limit.node]] / smallest, 1.5);
  double worst = 0;
  Index missed = 0, pressing = 0;
  for (int look = 0; look < 5; ++look) {
    const BruteForce all = brute_force(rings, rig.state.x, stiffness), found = listed(rig);
    worst = std::max(worst, std::abs(found.energy / all.energy - 1));
    missed += std::abs(all.pressing - found.pressing), pressing += all.pressing;
    for (int n = 0; n < 60; ++n) rig.stepper.step(0.5 * limit.dt, 0.5 * limit.dt);
  }
  report.compare_absolute(fmt::format("contacts missed, of {} in 5 configurations of a run", pressing), missed, 0, 0);
  report.at_most("their energy, relative difference", worst, 1e-12);
  const double largest = *std::max_element(tissue.rest_area.begin(), tissue.rest_area.end());
  draw_panels(bench, "ten_to_one", "Tissue of cells of ten to one.",
              {{&tissue, tissue.x, "", [&](Index c) {
                  return mix({0.97, 0.93, 0.80}, {0.35, 0.55, 0.75}, std::sqrt(tissue.rest_area[c] / largest));
                }}});
}

}  // namespace lamella::hard_cases
