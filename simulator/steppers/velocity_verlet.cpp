#include "simulator/steppers/velocity_verlet.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace lamella {

struct VelocityVerlet::Worker {
  explicit Worker(const ShellLayout& layout) : scratch(layout) {}
  ShellScratch scratch;
  LinkForces links;
};

struct VelocityVerlet::Run {
  Index load = 0;
  std::vector<Index> nodes;
  std::vector<Vec2> force;          // of a pushing load, in full [N]
  std::vector<Vec2> next_velocity;  // scratch of the step [m/s]
  Vec2 reaction = Vec2::Zero();     // on the sample, in this step [N]
  double work = 0, work_out = 0;    // so far; second half of this step's [J]
};

VelocityVerlet::~VelocityVerlet() = default;

VelocityVerlet::VelocityVerlet(Model& model, std::vector<Load>& loads, State& state, int threads)
    : model_(model),
      loads_(loads),
      state_(state),
      team_(std::max(1, threads)),
      f_(state.x.size()),
      box_(model, loads, state) {
  const ShellLayout& layout = model.layout;
  const Index blocks = static_cast<Index>(layout.blocks().size());
  if (model.dashpots || model.contact_damping > 0) damped_f_ = Field(state.x.size());
  shell_terms_ = model.shell_terms();
  for (int t = 0; t < team_.size(); ++t) workers_.emplace_back(layout);
  sums_.resize(blocks);
  boundary_.resize(blocks);
  broken_.resize(layout.chunks());
  dropped_kinetic_.assign(layout.chunks(), 0.0);
  if (model.rupture) broken_walls_.resize(layout.chunks());
  list_incoming();

  fully_held_.assign(state.x.size(), 0);
  runs_.resize(blocks);
  for (std::size_t l = 0; l < loads.size(); ++l) {
    const Load& load = loads[l];
    if (load.box) continue;
    Index block = 0;
    for (std::size_t k = 0; k < load.nodes.size(); ++k) {
      const Index node = load.nodes[k];
      while (node >= layout.blocks()[block].node_end) ++block;
      auto& runs = runs_[block];
      if (runs.empty() || runs.back().load != static_cast<Index>(l)) {
        runs.emplace_back();
        runs.back().load = static_cast<Index>(l);
      }
      Run& run = runs.back();
      run.nodes.push_back(node);
      if (load.pushes) run.force.push_back(load.force[k]);
      run.next_velocity.emplace_back(0, 0);
      if (load.holds[0]) fully_held_[node] |= 1;
      if (load.holds[1]) fully_held_[node] |= 2;
    }
  }
  for (auto& mask : fully_held_) mask = mask == 3;
  if (box_.moves()) fully_held_.back() = box_.held[0] && box_.held[1];
  if (model.links && model.links->softens()) booked_.fracture = -model.links->dissipated();  // before this stage
}

void VelocityVerlet::list_incoming() {
  const ShellLayout& layout = model_.layout;
  incoming_.assign(layout.chunks(), {});
  if (!model_.links) return;
  for (Index b = 0; b < static_cast<Index>(layout.blocks().size()); ++b)
    for (Index i = model_.links->middle(b); i < model_.links->end(b); ++i)
      incoming_[layout.chunk_of_block(layout.block_of_cell(model_.links->cell_b(i)))].emplace_back(b, i);
}

// A measured configuration is weighed before its breaks: 1/2 m v(n-1/2) . v(n+1/2) with the kick that it would have had whole.
double VelocityVerlet::dropped_kinetic(const std::vector<Break>& breaks, std::size_t first, double kick) const {
  double sum = 0;
  for (std::size_t k = first; k < breaks.size(); ++k) {
    const Link& link = model_.links->link(breaks[k].link);
    const Field& v = state_.v;
    sum += 0.5 * kick * breaks[k].dropped_force.dot(v.at(link.a) - v.at(link.b));
    sum += 0.5 * kick *
           breaks[k].dropped_frame_force.dot(v.at(link.a_prev) - v.at(link.a_next) + v.at(link.b_next) -
                                             v.at(link.b_prev));
    if (!box_.moves()) continue;
    const Sample& s = model_.sample;
    const auto share = [&](Index node) { return carried_share(s, node); };
    const Vec2 steps = s.link_image.empty() ? Vec2(0, 0) : steps_of(s.link_image[breaks[k].link]);
    const Vec2 on_box = breaks[k].dropped_force.cwiseProduct(share(link.a) - share(link.b) - steps) +
                        breaks[k].dropped_frame_force.cwiseProduct(share(link.a_prev) - share(link.a_next) +
                                                                   share(link.b_next) - share(link.b_prev));
    sum += 0.5 * kick * on_box.dot(box_.free_rate());
  }
  return sum;
}

// Contact takes over a broken link. Returns what it holds beyond what the energy of the break has left to it: where walls are bent or
// have slid far, the segments that the pair ignored until now may be overlapped. These forces act first in the step after
// the break, so their energy is that half-way between: the mean of before and after the drift, which keeps the ledger second order.
double VelocityVerlet::hand_over(const Break& event, double dt) {
  Contacts& contacts = *model_.contacts;
  Field& x = state_.x;
  const Wall& wall = model_.sample.walls[model_.sample.links[event.link].wall];
  std::vector<Index> cells{wall.cell_a};
  if (wall.cell_b != wall.cell_a) cells.push_back(wall.cell_b);  // a cell beside its own image moves once
  const auto mean = [&](auto&& energy) {
    const double after = energy();
    std::vector<Vec2> kept;
    for (const Index c : cells)
      for (Index i = model_.sample.cell_begin[c]; i < model_.sample.cell_begin[c + 1]; ++i) {
        kept.push_back(x.at(i));
        x.set(i, x.at(i) - dt * (box_.moves() ? box_.velocity(i) : state_.v.at(i)));
      }
    const Vec2 growth = box_growth(model_.sample, x);
    if (box_.moves()) x.set(model_.sample.nodes(), growth - dt * box_.rate());
    const double before = energy();
    if (box_.moves()) x.set(model_.sample.nodes(), growth);
    std::size_t k = 0;
    for (const Index c : cells)
      for (Index i = model_.sample.cell_begin[c]; i < model_.sample.cell_begin[c + 1]; ++i) x.set(i, kept[k++]);
    return 0.5 * (before + after);
  };
  const double ignoring = mean([&] { return contacts.pressing_across(event.link, x); });
  const double rubbing = contacts.release(event.link, x, event.friction_force);
  const double pressing =
      mean([&] { return contacts.pressing_across(event.link, x) - model_.links->left_to_contact(event, x); });
  return pressing - ignoring + rubbing - model_.links->left_to_friction(event);
}

// Takes broken bars out of the model. Links beside them get another frame, or none; contact loses a segment, and ends meet what they
// ignored. These forces act in full up to this step and as they are then from the next one on, so that what they lose is the mean of
// before and after the drift: the mean of the works of both kicks, second order in the step.
void VelocityVerlet::end_walls(std::vector<WallBreak>& now, double dt) {
  WallRupture& rupture = *model_.rupture;
  Contacts* const contacts = model_.contacts.get();
  CohesiveLinks* const links = model_.links.get();
  const Field& x = state_.x;
  const Field carried = box_.moves() ? box_.velocities() : Field();
  const Field& v = box_.moves() ? carried : state_.v;
  Field before(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) before.x[i] = x.x[i] - dt * v.x[i], before.y[i] = x.y[i] - dt * v.y[i];
  const auto held = [&] {
    double sum = 0;
    if (links) sum += 0.5 * (links->energy(before) + links->energy(x));
    if (contacts) sum += 0.5 * (contacts->energy(before) + contacts->energy(x));
    return sum;
  };
  double last = held();
  for (WallBreak& event : now) {
    rupture.end(event.cell, event.bar, state_.time);
    double of_links = 0;  // of those that have lost their frame
    if (links) {
      for (const Index l : links->without_tangent(rupture.broken())) {
        const double spent = links->dissipated(l);  // by damage: no part of what was held
        breaks_.push_back(links->cut(l, before, x));
        links->set_break_time(l, state_.time);
        of_links += breaks_.back().energy - spent;
        booked_.fracture += spent;
        if (contacts) contacts->release(l, x, breaks_.back().friction_force);
      }
      links->follow(rupture.broken());
    }
    if (contacts) contacts->lose(event.bar, x);
    const double next = held();
    event.energy += last - next - of_links;
    last = next;
    booked_.fracture += event.energy + of_links;
    booked_.pressure += event.pressure_work;
    wall_breaks_.push_back(event);
  }
  if (links) list_incoming();
  if (contacts) moved_ = 0;
}

// Links whose cells lie in different chunks, while all positions are still those of this step.
void VelocityVerlet::evaluate_boundary(Index chunk, double kick) {
  for (Index b = model_.layout.chunk(chunk); b < model_.layout.chunk(chunk + 1); ++b) {
    const Index first = model_.links->middle(b), last = model_.links->end(b);
    sums_[b].box.setZero();
    if (first == last) continue;
    if (model_.links->evaluate(state_.x, first, last, boundary_[b]))
      model_.links->break_exceeded(state_.x, first, last, boundary_[b], broken_[chunk]);
    model_.links->combine(first, last, boundary_[b]);
    if (box_.moves()) sums_[b].box = model_.links->force_on_box(first, last, boundary_[b]);
  }
  dropped_kinetic_[chunk] = dropped_kinetic(broken_[chunk], 0, kick);
}

// What the sweep of this block will read.
void VelocityVerlet::prefetch_block(Index b) const {
  using Arrays = std::initializer_list<const std::vector<double>*>;
  // Below, all lies in caches near enough, and asking costs more (4 % at 20,000 nodes) than it gains.
  constexpr std::size_t many = 100'000;
  if (state_.x.size() < many || b >= static_cast<Index>(model_.layout.blocks().size())) return;
  const CellBlock& block = model_.layout.blocks()[b];
  const Arrays swept = {&state_.x.x, &state_.x.y, &f_.x,        &f_.y,
                        &state_.v.x, &state_.v.y, &model_.mass, &model_.inverse_mass};
  for (const auto* values : swept) prefetch(*values, block.node_begin, block.node_end);
  for (const ShellTerm* term : shell_terms_) term->prefetch_block(block);
  if (!model_.links) return;
  model_.links->prefetch_stations(model_.links->begin(b), model_.links->middle(b));
  // Links reach on into the next row of cells, as far as the blocks move on.
  const Index begin = b > 0 ? model_.links->farthest_node(b - 1) : 0, end = model_.links->farthest_node(b) + 1;
  const Arrays linked = {&state_.x.x, &state_.x.y, &f_.x, &f_.y};
  for (const auto* values : linked) prefetch(*values, begin, end);
}

template <bool Measured>
void VelocityVerlet::sweep_block(Index b, Worker& w, double dt, double kick, Field* force_on_node) {
  const CellBlock& block = model_.layout.blocks()[b];
  const Sample& sample = model_.sample;
  Field &x = state_.x, &v = state_.v;
  BlockSums& sums = sums_[b];
  prefetch_block(b + 1);

  // forces
  if (CohesiveLinks* links = model_.links.get()) {
    const Index first = links->begin(b), last = links->middle(b);
    if (links->evaluate(x, first, last, w.links)) {
      const Index chunk = model_.layout.chunk_of_block(b);
      const std::size_t before = broken_[chunk].size();
      links->break_exceeded(x, first, last, w.links, broken_[chunk]);
      dropped_kinetic_[chunk] += dropped_kinetic(broken_[chunk], before, kick);
    }
    links->combine(first, last, w.links);
    links->scatter(w.links, first, last, f_);
    if (box_.moves() && first != last) sums.box += links->force_on_box(first, last, w.links);
  }
  if (model_.gravity) model_.gravity->add_force_to(block.node_begin, block.node_end, f_);
  w.scratch.load(sample, block, x);
  for (ShellTerm* term : shell_terms_) term->add_to_block(w.scratch, f_);
  w.scratch.add_section_forces(sample, f_);
  for (ShellTerm* term : shell_terms_)
    if (term->has_history()) term->commit_block(b, w.scratch);
  if (model_.rupture && model_.rupture->exceeded(w.scratch)) {
    const Index chunk = model_.layout.chunk_of_block(b);
    const auto drop = [&](Index node, const Vec2& force) {
      f_.add(node, -force);
      if (!fully_held_[node]) dropped_kinetic_[chunk] += 0.5 * kick * force.dot(v.at(node));
      if (box_.moves())
        dropped_kinetic_[chunk] += 0.5 * kick * carried_share(sample, node).cwiseProduct(force).dot(box_.free_rate());
    };
    model_.rupture->break_exceeded(w.scratch, drop, broken_walls_[chunk]);
  }
  if constexpr (Measured) {
    double square = 0;
    for (Index c = block.cell_begin; c < block.cell_end; ++c) {
      const Index at = ShellLayout::slot(c, sample.cell_begin[c]) - block.slot_begin;
      for (Index k = at; k < at + sample.segments(c); ++k)
        square += w.scratch.sx[k] * w.scratch.sx[k] + w.scratch.sy[k] * w.scratch.sy[k];
    }
    sums.section_square = square;
  }
  if (model_.dashpots) {
    std::fill_n(w.scratch.sx.begin(), block.slots, 0.0);
    std::fill_n(w.scratch.sy.begin(), block.slots, 0.0);
    w.scratch.load_velocity(sample, box_.moves() ? carried_v_ : v);
    model_.dashpots->add_to_block(w.scratch);
    w.scratch.add_section_forces(sample, damped_f_);
  }
  double *X = x.x.data(), *Y = x.y.data(), *VX = v.x.data(), *VY = v.y.data(), *FX = f_.x.data(), *FY = f_.y.data();
  const double *MASS = model_.mass.data(), *IM = model_.inverse_mass.data();
  if (damped_f_.size() > 0)
    for (Index i = block.node_begin; i < block.node_end; ++i) FX[i] += damped_f_.x[i], FY[i] += damped_f_.y[i];

  if (box_.moves()) add_to_box(block, sums);

  // loads: forces first, then what holds; a held component leaves the sweep with velocity and force 0 and is moved after it
  double held_kinetic = 0;
  double damped_in = 0, damped_out = 0;  // work of dashpots
  for (Run& run : runs_[b]) {
    const Load& load = loads_[run.load];
    run.reaction.setZero();
    if (!load.pushes) continue;
    for (std::size_t k = 0; k < run.nodes.size(); ++k) {
      const Vec2 push = load.factor * run.force[k];
      f_.add(run.nodes[k], push);
      run.reaction += push;
      if (Measured && force_on_node) force_on_node->add(run.nodes[k], push);
    }
  }
  for (Run& run : runs_[b]) {
    const Load& load = loads_[run.load];
    run.work_out = 0;
    double work_in = 0;
    for (std::size_t k = 0; k < run.nodes.size(); ++k) {
      const Index i = run.nodes[k];
      for (int c = 0; c < 2; ++c) {
        double& velocity = c == 0 ? VX[i] : VY[i];
        double& force = c == 0 ? FX[i] : FY[i];
        if (load.holds[c]) {
          const double next = load.factor * load.velocity[c];
          const double reaction = MASS[i] * (next - velocity) / kick - force;
          // What the sample feels: without the inertia of the held nodes, which would show every change of speed as a spike.
          run.reaction[c] -= force;
          if (Measured && force_on_node) (c == 0 ? force_on_node->x : force_on_node->y)[i] -= force;
          work_in += 0.5 * kick * reaction * velocity;
          run.work_out += 0.5 * kick * reaction * next;
          if constexpr (Measured) held_kinetic += 0.5 * MASS[i] * velocity * next;
          if (damped_f_.size() > 0) {
            const double damped = c == 0 ? damped_f_.x[i] : damped_f_.y[i];
            damped_in -= damped * velocity, damped_out -= damped * next;
          }
          run.next_velocity[k][c] = next;
          velocity = 0, force = 0;
        }
      }
    }
    run.work += work_in + run.work_out;
  }
  // work of pushing forces needs the velocities before and after; before:
  for (Run& run : runs_[b]) {
    const Load& load = loads_[run.load];
    if (!load.pushes) continue;
    for (std::size_t k = 0; k < run.nodes.size(); ++k)
      run.work += 0.5 * kick * load.factor * run.force[k].dot(v.at(run.nodes[k]));
  }
  if (damped_f_.size() > 0)
    for (Index i = block.node_begin; i < block.node_end; ++i)
      damped_in -= damped_f_.x[i] * VX[i] + damped_f_.y[i] * VY[i];

  // kick and drift; drag half implicit: it does not shorten the stable step
  const double g = 0.5 * model_.drag_rate * kick, c1 = (1 - g) / (1 + g), c2 = kick / (1 + g);
  double damping = 0, damping_in = 0, kinetic = 0, fastest = 0, largest = 0;
  const Index begin = block.node_begin, end = block.node_end;
#pragma omp simd reduction(+ : damping, damping_in, kinetic) reduction(max : fastest, largest)
  for (Index i = begin; i < end; ++i) {
    const double nx = c1 * VX[i] + c2 * FX[i] * IM[i], ny = c1 * VY[i] + c2 * FY[i] * IM[i];
    const double mx = 0.5 * (VX[i] + nx), my = 0.5 * (VY[i] + ny);
    damping += MASS[i] * (mx * mx + my * my);
    if constexpr (Measured) {
      damping_in += MASS[i] * (mx * VX[i] + my * VY[i]);
      kinetic += MASS[i] * (VX[i] * nx + VY[i] * ny);
      largest = std::max(largest, FX[i] * FX[i] + FY[i] * FY[i]);
    }
    fastest = std::max(fastest, nx * nx + ny * ny);
    X[i] += dt * nx, Y[i] += dt * ny;
    VX[i] = nx, VY[i] = ny;
    FX[i] = 0, FY[i] = 0;
  }
  const double drag_work = model_.drag_rate * kick * damping;
  if (damped_f_.size() > 0)
    for (Index i = begin; i < end; ++i) {
      damped_out -= damped_f_.x[i] * VX[i] + damped_f_.y[i] * VY[i];
      damped_f_.x[i] = damped_f_.y[i] = 0;
    }
  sums.damping += drag_work + 0.5 * kick * (damped_in + damped_out);
  if constexpr (Measured) {
    sums.damping_out = drag_work - 0.5 * model_.drag_rate * kick * damping_in + 0.5 * kick * damped_out;
    sums.kinetic = 0.5 * kinetic + held_kinetic;
    sums.largest_force = largest;
  }

  for (Run& run : runs_[b]) {
    const Load& load = loads_[run.load];
    for (std::size_t k = 0; k < run.nodes.size(); ++k) {
      const Index i = run.nodes[k];
      if (load.pushes) {
        const double out = 0.5 * kick * load.factor * run.force[k].dot(v.at(i));
        run.work += out, run.work_out += out;
      }
      if (load.holds[0]) VX[i] = run.next_velocity[k].x(), X[i] += dt * VX[i];
      if (load.holds[1]) VY[i] = run.next_velocity[k].y(), Y[i] += dt * VY[i];
      fastest = std::max(fastest, VX[i] * VX[i] + VY[i] * VY[i]);
    }
  }
  sums.speed = fastest;
}

// The share of the nodes' forces, complete now.
void VelocityVerlet::add_to_box(const CellBlock& block, BlockSums& sums) {
  sums.box_damped.setZero();
  sums.box += box_.share_of(f_, block.node_begin, block.node_end);
  if (damped_f_.size() > 0) sums.box_damped = box_.share_of(damped_f_, block.node_begin, block.node_end);
}

void VelocityVerlet::step_box(double dt, double kick) {
  const Index node = model_.sample.nodes();
  Vec2 force = f_.at(node), damped = damped_f_.size() > 0 ? damped_f_.at(node) : Vec2(0, 0);
  force += damped;
  for (BlockSums& s : sums_) {
    force += s.box, damped += s.box_damped;
    s.box.setZero();
  }
  f_.set(node, Vec2(0, 0));
  if (damped_f_.size() > 0) damped_f_.set(node, Vec2(0, 0));
  box_.advance(force, damped, dt, kick);
}

template <bool Measured>
void VelocityVerlet::advance(double dt, double kick, Field* force_on_node) {
  Contacts* const contacts = model_.contacts.get();
  if (contacts && 2 * moved_ > contacts->skin()) {
    contacts->update_candidates(state_.x);
    moved_ = 0;
  }
  if (box_.moves() && damped_f_.size() > 0) carried_v_ = box_.velocities();
  const Field& v = box_.moves() && damped_f_.size() > 0 ? carried_v_ : state_.v;
  const Index chunks = model_.layout.chunks();
  const bool detour = model_.links && chunks > 1;
  const int team = team_.size();
  team_.run([&](int thread) {
    Worker& worker = workers_[thread];
    const Index first = chunks * thread / team, last = chunks * (thread + 1) / team;
    if (contacts && contacts->active() > 0) {
      const std::int64_t pairs = contacts->active();
      contacts->evaluate(state_.x, v, static_cast<Index>(pairs * thread / team),
                         static_cast<Index>(pairs * (thread + 1) / team));
      team_.meet();
      if (thread == 0) contacts->scatter(f_, damped_f_);
      if (!detour) team_.meet();
    }
    if (detour) {
      for (Index c = first; c < last; ++c) evaluate_boundary(c, kick);
      team_.meet();
    }
    for (Index c = first; c < last; ++c) {
      if (detour) {
        const CohesiveLinks& links = *model_.links;
        for (Index b = model_.layout.chunk(c); b < model_.layout.chunk(c + 1); ++b)
          links.scatter_a(boundary_[b], 0, links.middle(b), links.end(b), f_);
        for (const auto& [b, i] : incoming_[c]) links.scatter_b(boundary_[b], i - links.middle(b), i, i + 1, f_);
      }
      for (Index b = model_.layout.chunk(c); b < model_.layout.chunk(c + 1); ++b)
        sweep_block<Measured>(b, worker, dt, kick, force_on_node);
    }
  });

  if constexpr (!Measured) std::fill(dropped_kinetic_.begin(), dropped_kinetic_.end(), 0.0);
  double fastest = 0;
  for (const auto& s : sums_) fastest = std::max(fastest, s.speed);
  if (box_.moves()) step_box(dt, kick);
  moved_ += (box_.moves() ? box_.fastest : std::sqrt(fastest)) * dt;
  if (contacts) contacts->advance();
  std::vector<Break> now;
  for (auto& list : broken_) now.insert(now.end(), list.begin(), list.end()), list.clear();
  std::sort(now.begin(), now.end(), [](const Break& a, const Break& b) { return a.link < b.link; });
  for (Break& event : now) {
    model_.links->set_break_time(event.link, state_.time);
    if (contacts) event.energy -= hand_over(event, dt);
    booked_.fracture += event.energy;
    breaks_.push_back(event);
  }
  if (model_.rupture) {
    std::vector<WallBreak> walls;  // chunk by chunk: in the order of their bars
    for (auto& list : broken_walls_) walls.insert(walls.end(), list.begin(), list.end()), list.clear();
    if (!walls.empty()) end_walls(walls, dt);
  }
  state_.time += dt;
  ++state_.step;
  ++steps_;
}

void VelocityVerlet::step(double dt, double kick) { advance<false>(dt, kick, nullptr); }

// At the start of the step that has just been measured: the second halves of its works are still to come.
Works VelocityVerlet::works_at_start() const {
  Works w = booked_;
  for (const auto& runs : runs_)
    for (const Run& run : runs) w.loads += run.work - run.work_out;
  for (const BlockSums& s : sums_) w.damping += s.damping - s.damping_out;
  w.loads += box_.work - box_.work_out, w.damping += box_.damping - box_.damping_out;
  return w;
}

Measurement VelocityVerlet::measured_step(double dt, double kick, Field* force_on_node) {
  // History that moves in this step belongs to its end.
  Works history = booked_;
  history.plastic += model_.plastic_dissipated();
  if (model_.contacts && model_.friction > 0) history.friction = model_.contacts->friction_dissipated();
  if (model_.links)
    history.fracture += model_.links->dissipated();  // that of a broken link has been booked with its break

  advance<true>(dt, kick, force_on_node);

  Measurement m;
  m.works = works_at_start();
  m.works.plastic = history.plastic, m.works.friction = history.friction, m.works.fracture = history.fracture;
  m.works.pressure = history.pressure;
  m.load_force.assign(loads_.size(), Vec2::Zero());
  for (const auto& runs : runs_)
    for (const Run& run : runs) m.load_force[run.load] += run.reaction;
  if (box_.load >= 0) m.load_force[box_.load] += box_.reaction;
  m.kinetic += box_.kinetic;
  double square = 0, largest = 0;
  for (const BlockSums& s : sums_) {
    m.kinetic += s.kinetic;
    square += s.section_square;
    largest = std::max(largest, s.largest_force);
  }
  largest = std::max(largest, box_.largest_force * box_.largest_force);
  for (double& dropped : dropped_kinetic_) m.kinetic += std::exchange(dropped, 0.0);
  const double rms = std::sqrt(square / std::max<std::size_t>(1, state_.x.size()));
  m.unbalanced = largest > 0 ? std::sqrt(largest) / (std::sqrt(largest) + rms) : 0.0;
  return m;
}

std::vector<Break> VelocityVerlet::take_breaks() { return std::exchange(breaks_, {}); }

std::vector<WallBreak> VelocityVerlet::take_wall_breaks() { return std::exchange(wall_breaks_, {}); }

void VelocityVerlet::save(ArraySet& restart) const {
  std::vector<double> loads, damping;
  for (const auto& runs : runs_)
    for (const Run& run : runs) loads.push_back(run.work);
  for (const BlockSums& s : sums_) damping.push_back(s.damping);
  restart.add({"stepper_load_work", "J", "run", 1, std::move(loads)});
  restart.add({"stepper_damping", "J", "block", 1, std::move(damping)});
  restart.add({"stepper_booked", "J", "model", 1, std::vector<double>{booked_.fracture, booked_.pressure}});
  if (box_.moves()) restart.add({"stepper_box", "J", "model", 1, std::vector<double>{box_.work, box_.damping}});
}

void VelocityVerlet::restore(const ArraySet& restart) {
  std::size_t k = 0;
  const auto& loads = restart.doubles("stepper_load_work");
  for (auto& runs : runs_)
    for (Run& run : runs) run.work = loads.at(k++);
  const auto& damping = restart.doubles("stepper_damping");
  for (std::size_t b = 0; b < sums_.size(); ++b) sums_[b].damping = damping.at(b);
  const auto& booked = restart.doubles("stepper_booked");
  booked_.fracture = booked.at(0);
  if (booked.size() > 1) booked_.pressure = booked[1];  // not in files of before walls could break
  if (box_.moves())
    box_.work = restart.doubles("stepper_box").at(0), box_.damping = restart.doubles("stepper_box").at(1);
}

}  // namespace lamella
