#include "simulator/contact/contacts.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace lamella {
namespace {

/// Half a mean segment, or as much less as it takes to leave the walls of a bonded tissue out of the list: a node there is sqrt(l^2 + 4 r^2)
/// away from the nearest segment that does not meet at its link.
double chosen_skin(const Sample& sample) {
  double length = 0, radius = 0;
  Index count = 0;
  for (double l : sample.rest_length)
    if (l > 0) length += l, ++count;
  for (double r : sample.radius) radius += r / sample.cells();
  if (count == 0) return 1;
  length /= count;
  return std::clamp(0.95 * (std::hypot(length, 2 * radius) - 2 * radius), 0.1 * length, 0.5 * length);
}

/// Adds the 2 x 2 blocks of a matrix over a few nodes to a sink, leaving out those that are zero.
template <class Nodes, class Matrix>
void add_blocks(const Nodes& nodes, const Matrix& h, StiffnessSink& sink) {
  const int count = static_cast<int>(nodes.size());
  for (int a = 0; a < count; ++a)
    for (int b = 0; b < count; ++b) {
      const Eigen::Matrix2d block = h.template block<2, 2>(2 * a, 2 * b);
      if (!block.isZero(0)) sink.add(nodes[a], nodes[b], block);
    }
}

std::array<Index, 3> nodes_of(Index node, const Foot& foot) { return {node, foot.segment, foot.next}; }

constexpr Index kMostNodes = 2 + 2 * kMaxFeet;  // the box among them
using LargeMatrix = Eigen::Matrix<double, 2 * kMostNodes, 2 * kMostNodes>;

/// Adds the rows and columns of a box that displaces the first node of a matrix.
template <class Matrix>
void add_box_blocks(Index box, const Vec2& steps, const std::array<Index, 3>& nodes, const Matrix& h,
                    StiffnessSink& sink) {
  if (box < 0) return;
  const Eigen::DiagonalMatrix<double, 2> by(steps);
  for (int a = 0; a < 3; ++a) {
    const Eigen::Matrix2d block = by * h.template block<2, 2>(0, 2 * a);
    sink.add(box, nodes[a], block), sink.add(nodes[a], box, block.transpose());
  }
  sink.add(box, box, by * h.template block<2, 2>(0, 0) * by);
}

/// Second derivative of W / k by the positions of all nodes concerned. A box that displaces the node by its steps is one of them.
void add_overlap_stiffness(Index node, Index box, const Vec2& steps, const Feet& feet, const Overlap& o, double k,
                           const Field& x, StiffnessSink& sink) {
  std::vector<Index> nodes{node};
  if (box >= 0) nodes.push_back(box);
  const Eigen::DiagonalMatrix<double, 2> by(steps);
  std::array<std::array<int, 3>, kMaxFeet> place{};
  std::array<FootDerivatives, kMaxFeet> d;
  for (int f = 0; f < feet.count; ++f) {
    d[f] = differentiate(feet.foot[f], x);
    const auto own = nodes_of(node, feet.foot[f]);
    for (int a = 0; a < 3; ++a) {
      const auto found = std::find(nodes.begin(), nodes.end(), own[a]);
      place[f][a] = static_cast<int>(found - nodes.begin());
      if (found == nodes.end()) nodes.push_back(own[a]);
    }
  }
  const Matrix6 s = overlap_stiffness(feet, o);
  LargeMatrix h = LargeMatrix::Zero();
  for (int f = 0; f < feet.count; ++f)
    for (int g = 0; g < feet.count; ++g) {
      // An overlap falls as the distance grows: hence the minus signs.
      Matrix6 part = s(f, g) * d[f].distance * d[g].distance.transpose() -
                     s(f, 3 + g) * d[f].distance * d[g].direction.transpose() -
                     s(3 + f, g) * d[f].direction * d[g].distance.transpose() +
                     s(3 + f, 3 + g) * d[f].direction * d[g].direction.transpose();
      if (f == g) part += o.turn[f] * d[f].direction2 - o.lambda[f] * d[f].distance2;
      for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b)
          h.block<2, 2>(2 * place[f][a], 2 * place[g][b]) += k * part.block<2, 2>(2 * a, 2 * b);
      if (box < 0) continue;
      for (int a = 0; a < 3; ++a) {
        h.block<2, 2>(2 * place[f][a], 2) += k * part.block<2, 2>(2 * a, 0) * by;
        h.block<2, 2>(2, 2 * place[g][a]) += k * by * part.block<2, 2>(0, 2 * a);
      }
      h.block<2, 2>(2, 2) += k * by * part.block<2, 2>(0, 0) * by;
    }
  add_blocks(nodes, h, sink);
}

bool before(const Pair& a, const Pair& b) {
  return std::tie(a.node, a.cell, a.image) < std::tie(b.node, b.cell, b.image);
}

}  // namespace

Contacts::Contacts(const Sample& sample, ContactParameters parameters, const Field& x0)
    : sample_(sample),
      p_(std::move(parameters)),
      cell_of_(cell_of_node(sample)),
      self_reach_(sample),
      linked_(sample, cell_of_),
      rules_{sample, cell_of_, p_.bare, self_reach_, linked_, p_.skin > 0 ? p_.skin : chosen_skin(sample)} {
  if (p_.bare.empty()) p_.bare.assign(sample.cells(), 0);
  inside_ = nodes_inside(x0);
  rebuild(x0);
}

// ---- one pair -----------------------------------------------------------------------------------------------------

double Contacts::stiffness(const Pair& pair) const {
  double k = p_.node_stiffness[pair.node];
  if (!pair_stiffness_.empty()) {
    double linked = 0;
    for (const auto& partner : linked_.of(pair.node))
      if (partner.cell == pair.cell && partner.image == pair.image) linked += pair_stiffness_[partner.link];
    if (linked > 0) k = linked;
  }
  return p_.bare[pair.cell] ? k : 0.5 * k;
}

double Contacts::reach(const Pair& pair) const {
  return sample_.radius[cell_of_[pair.node]] + sample_.radius[pair.cell];
}

// Critical for a node on a bare wall, and for two equal nodes that face each other: reduced mass m/2, stiffness k_n, two dashpots.
double Contacts::dashpot(const Pair& pair) const {
  return (p_.bare[pair.cell] ? 2.0 : 1.0) * p_.damping * std::sqrt(stiffness(pair) * p_.node_mass[pair.node]);
}

Contacts::Touch Contacts::touch(const CandidateList& list, const Pair& pair, const Field& x) const {
  Touch out;
  const double range = reach(pair);
  out.feet = find_feet(sample_, x, pair.node, pair.cell, list.of(pair), range, rules_.broken, shift(pair, x));
  if (out.feet.count == 0) return out;
  out.overlap = overlap(out.feet, range);
  out.k = stiffness(pair);
  return out;
}

Sliding Contacts::sliding(Index pair, const Slip& slip) const {
  const FrictionSpring& spring = spring_[pair];
  return slide(spring.stretch + slip.value, spring.limit, tangential_stiffness(list_.pairs[pair]));
}

/// The spring anchored anew where the node touches now, its stretch cut to what mu f_n still holds.
FrictionSpring Contacts::next_spring(const Pair& pair, const Touch& t, const Field& x, double stretch,
                                     double& dissipated) const {
  const double k_t = tangential_stiffness(pair);
  FrictionSpring next;
  double held = 0;
  if (const int foot = heaviest(t.feet, t.overlap); foot >= 0 && k_t > 0) {
    next = anchored_at(t.feet.foot[foot], x);
    next.limit = p_.friction * t.k * pressing(t.feet, t.overlap, foot);
    held = std::clamp(stretch, -next.limit / k_t, next.limit / k_t);
  }
  next.stretch = held;
  dissipated += 0.5 * k_t * (stretch - held) * (stretch + held);  // exactly 0 where nothing is cut
  return next;
}

// ---- generic ------------------------------------------------------------------------------------------------------

bool Contacts::covers(const Field& x) const {
  if (stale_) return false;
  const double most = 0.25 * rules_.skin * rules_.skin;
  if (box_moves(sample_, x)) return drift_.relative(sample_, x) <= rules_.skin;
  for (std::size_t i = 0; i < x.size(); ++i)
    if (!((x.at(i) - drift_.start().at(i)).squaredNorm() <= most)) return drift_.relative(sample_, x) <= rules_.skin;
  return true;
}

// A wall pushes by its unsigned distance, so that one which has jumped to the other side of another is pushed on.
double Contacts::safe_share(const Field& x, const Field& way) {
  if (!covers(x)) rebuild(x);
  double share = 1;
  for (const Pair& pair : list_.pairs)
    for (const Index s : list_.of(pair)) {
      const Index next = sample_.next(pair.cell, s);
      const Vec2 w = way.at(pair.node) + steps_of(pair.image).cwiseProduct(box_growth(sample_, way));
      const double relative = std::sqrt(std::max((w - way.at(s)).squaredNorm(), (w - way.at(next)).squaredNorm()));
      const double distance = std::sqrt(squared_distance(x.at(pair.node) + shift(pair, x), x.at(s), x.at(next)));
      if (share * relative > 0.5 * distance) share = 0.5 * distance / relative;
    }
  // What is not listed is further away than the reach, and what is left of the skin.
  const double radius = *std::min_element(sample_.radius.begin(), sample_.radius.end());
  const double free = rules_.skin - std::min(rules_.skin, drift_.relative(sample_, x)) + radius;
  while (share > 0) {
    Field part(way.size());
    for (std::size_t i = 0; i < way.size(); ++i) part.set(i, share * way.at(i));
    const double relative = drift_.relative_motion(sample_, part);
    if (relative <= free * (1 + 1e-9)) break;
    share *= std::isfinite(relative) ? free / relative : 0.5;
  }
  return share;
}

double Contacts::energy(const Field& x) const {
  double sum = 0;
  for_each_touch(x, [&](const Pair&, const Touch& t) { sum += t.k * t.overlap.energy; });
  for_each_spring([&](Index k, const Pair& pair, const FrictionSpring& spring) {
    sum += sliding(k, slip(spring, x, pair)).potential;
  });
  return sum;
}

void Contacts::add_force(const Field& x, Field& f) const {
  const auto add = [&](const Pair& pair, const std::array<Index, 3>& nodes, const Vector6& force) {
    for (int a = 0; a < 3; ++a) f.add(nodes[a], force.segment<2>(2 * a));
    if (const BoxEntry box = box_of(pair, x); box.node >= 0) f.add(box.node, box.steps.cwiseProduct(force.head<2>()));
  };
  for_each_touch(x, [&](const Pair& pair, const Touch& t) {
    for (int k = 0; k < t.feet.count; ++k) {
      const Foot& foot = t.feet.foot[k];
      const FootDerivatives d = differentiate(foot, x);
      add(pair, nodes_of(pair.node, foot), t.k * (t.overlap.lambda[k] * d.distance - t.overlap.turn[k] * d.direction));
    }
  });
  for_each_spring([&](Index k, const Pair& pair, const FrictionSpring& spring) {
    const Slip moved = slip(spring, x, pair);
    add(pair, {pair.node, spring.segment, spring.next}, -sliding(k, moved).force * slip_gradient(spring, moved));
  });
}

void Contacts::add_stiffness(const Field& x, StiffnessSink& sink) const {
  for_each_touch(x, [&](const Pair& pair, const Touch& t) {
    if (!sink.begin_elements(cell_of_[pair.node])) return;
    const BoxEntry box = box_of(pair, x);
    add_overlap_stiffness(pair.node, box.node, box.steps, t.feet, t.overlap, t.k, x, sink);
  });
  for_each_spring([&](Index k, const Pair& pair, const FrictionSpring& spring) {
    if (!sink.begin_elements(cell_of_[pair.node])) return;
    const Slip moved = slip(spring, x, pair);
    const Sliding s = sliding(k, moved);
    Matrix6 h = s.force * slip_stiffness(spring, x, pair.node, shift(pair, x));
    if (s.slipped == 0) {
      const Vector6 g = slip_gradient(spring, moved);
      h += tangential_stiffness(pair) * g * g.transpose();
    }
    const std::array<Index, 3> nodes{pair.node, spring.segment, spring.next};
    add_blocks(nodes, h, sink);
    const BoxEntry box = box_of(pair, x);
    add_box_blocks(box.node, box.steps, nodes, h, sink);
  });
}

void Contacts::commit(const Field& x) {
  if (p_.friction == 0) return;
  if (!covers(x)) update_candidates(x);
  evaluate(x, Field(x.size()), 0, active());
  advance();
}

std::size_t Contacts::bytes() const {
  return sizeof(Index) * cell_of_.size() + self_reach_.bytes() + linked_.bytes() +
         sizeof(double) * (pair_stiffness_.size() + p_.node_stiffness.size() + p_.node_mass.size()) +
         sizeof(inside_[0]) * inside_.size() + drift_.bytes() + sizeof(Pair) * list_.pairs.size() +
         sizeof(Index) * list_.segments.size() + forces_.size() + sizeof(Outcome) * outcome_.size() +
         2 * sizeof(FrictionSpring) * spring_.size() + sizeof(double) * slid_.size();
}

// ---- the stepper's path -------------------------------------------------------------------------------------------

// Until the next call neighbours move by skin() against each other at most, half of which each.
void Contacts::update_candidates(const Field& x) {
  if (stale_ || !(drift_.relative(sample_, x) + skin() <= rules_.skin)) rebuild(x);
}

void Contacts::rebuild(const Field& x) {
  CandidateList list = find_candidates(rules_, x);
  if (p_.friction > 0) {
    std::vector<FrictionSpring> kept(list.pairs.size());
    std::size_t old = 0;
    for (std::size_t k = 0; k < list.pairs.size(); ++k) {
      while (old < list_.pairs.size() && before(list_.pairs[old], list.pairs[k])) ++old;
      if (old < list_.pairs.size() && !before(list.pairs[k], list_.pairs[old])) kept[k] = spring_[old];
    }
    spring_ = std::move(kept);
    trial_ = spring_;
    slid_.assign(spring_.size(), 0.0);
  }
  list_ = std::move(list);
  forces_.assign(list_.pairs.size(), 0);
  outcome_.resize(list_.pairs.size());
  drift_ = Drift(sample_, x, 2 * *std::max_element(sample_.radius.begin(), sample_.radius.end()) + rules_.skin);
  stale_ = false;
}

void Contacts::evaluate_friction(Index k, const Touch& t, const Field& x) {
  const FrictionSpring& spring = spring_[k];
  const Pair& pair = list_.pairs[k];
  double stretch = 0, force = 0;
  slid_[k] = 0;
  if (spring.acts()) {
    const Slip moved = slip(spring, x, pair);
    const Sliding s = sliding(k, moved);
    outcome_[k][forces_[k]++] = {spring.segment,          spring.next, spring.t, -s.force * moved.tangent,
                                 -s.force * moved.couple, Vec2(0, 0)};
    stretch = s.stretch;
    // The mean of the forces at both ends, as the stepper's own work: second order in the step while the limit changes.
    slid_[k] = 0.5 * (std::abs(spring.force) + std::abs(s.force)) * s.slipped;
    force = s.force;
  }
  trial_[k] = next_spring(pair, t, x, stretch, slid_[k]);
  trial_[k].force = force;
}

void Contacts::evaluate(const Field& x, const Field& v, Index begin, Index end) {
  const bool rubs = p_.friction > 0;
  for (Index k = begin; k < end; ++k) {
    const Pair& pair = list_.pairs[k];
    forces_[k] = 0;
    const Touch t = touch(list_, pair, x);
    for (int f = 0; f < t.feet.count; ++f) {
      const double push = t.k * t.overlap.lambda[f];
      if (push <= 0) continue;
      const Foot& foot = t.feet.foot[f];
      FootForce& out = outcome_[k][forces_[k]++];
      out = {foot.segment, foot.next, foot.t, push * foot.n, Vec2(0, 0), Vec2(0, 0)};
      if (t.overlap.turn[f] != 0) {
        const Vector6 turn = -t.k * t.overlap.turn[f] * differentiate(foot, x).direction;
        if (foot.at_vertex())
          out.force += turn.head<2>();
        else
          out.couple += turn.tail<2>();
      }
      if (p_.damping > 0) {
        const Vec2 relative = v.at(pair.node) + steps_of(pair.image).cwiseProduct(box_growth(sample_, v)) -
                              (1 - foot.t) * v.at(foot.segment) - foot.t * v.at(foot.next);
        out.damping = std::max(-push, -dashpot(pair) * foot.n.dot(relative)) * foot.n;
      }
    }
    if (rubs && (forces_[k] > 0 || spring_[k].acts())) {
      evaluate_friction(k, t, x);
    } else if (rubs) {
      trial_[k] = FrictionSpring{};
      slid_[k] = 0;
    }
  }
}

void Contacts::scatter(Field& f, Field& damped_f) const {
  const bool box_too = box_moves(sample_, f);
  for (std::size_t k = 0; k < forces_.size(); ++k) {
    const Index node = list_.pairs[k].node;
    for (int a = 0; a < forces_[k]; ++a) {
      const FootForce& out = outcome_[k][a];
      f.add(node, out.force);
      f.add(out.segment, (out.t - 1) * out.force - out.couple);
      f.add(out.next, out.couple - out.t * out.force);
      if (p_.damping > 0) {
        damped_f.add(node, out.damping);
        damped_f.add(out.segment, (out.t - 1) * out.damping);
        damped_f.add(out.next, -out.t * out.damping);
      }
      if (!box_too) continue;
      if (const BoxEntry box = box_of(list_.pairs[k], f); box.node >= 0) {
        f.add(box.node, box.steps.cwiseProduct(out.force));
        if (p_.damping > 0) damped_f.add(box.node, box.steps.cwiseProduct(out.damping));
      }
    }
  }
}

void Contacts::advance() {
  for (std::size_t k = 0; k < spring_.size(); ++k) {
    if (!spring_[k].acts() && !trial_[k].acts()) continue;
    spring_[k] = trial_[k];
    dissipated_ += slid_[k];
    slid_[k] = 0;
  }
}

void Contacts::lose(Index bar, const Field& x) {
  for (std::size_t k = 0; k < spring_.size(); ++k)
    if (spring_[k].acts() && spring_[k].segment == bar) spring_[k] = trial_[k] = FrictionSpring{};
  rebuild(x);
}

double Contacts::stored_in_friction() const {
  double sum = 0;
  for_each_spring([&](Index, const Pair& pair, const FrictionSpring& spring) {
    sum += 0.5 * tangential_stiffness(pair) * spring.stretch * spring.stretch;
  });
  return sum;
}

// ---- links --------------------------------------------------------------------------------------------------------

void Contacts::set_intact(Index link) {
  linked_.set_intact(link, 1);
  stale_ = true;
}

void Contacts::set_pair_stiffness(Index link, double k_n) {
  pair_stiffness_.resize(sample_.links.size(), 0.0);
  pair_stiffness_[link] = k_n;
}

std::optional<Index> Contacts::place_of(const Pair& pair) const {
  const auto at = std::lower_bound(list_.pairs.begin(), list_.pairs.end(), pair, before);
  if (at == list_.pairs.end() || before(pair, *at)) return std::nullopt;
  return static_cast<Index>(at - list_.pairs.begin());
}

/// Lists the pair (again) by the rules as they are now, as it was when the list was made. Returns its place.
Index Contacts::list_pair(const Pair& asked) {
  Pair pair{asked.node, asked.cell, static_cast<Index>(list_.segments.size()), 0, asked.image};
  for (Index s = sample_.cell_begin[pair.cell]; s < sample_.cell_begin[pair.cell + 1]; ++s)
    if (sample_.starts_segment(pair.cell, s) && rules_.candidates(drift_.start(), pair.node, pair.cell, s, pair.image))
      list_.segments.push_back(s), ++pair.count;
  if (const auto listed = place_of(pair)) {
    list_.pairs[*listed] = pair;
    return *listed;
  }
  const auto at = std::lower_bound(list_.pairs.begin(), list_.pairs.end(), pair, before);
  const std::ptrdiff_t k = at - list_.pairs.begin();
  list_.pairs.insert(at, pair);
  forces_.insert(forces_.begin() + k, 0);
  outcome_.resize(list_.pairs.size());
  if (p_.friction > 0) {
    spring_.emplace(spring_.begin() + k);
    trial_.emplace(trial_.begin() + k);
    slid_.insert(slid_.begin() + k, 0.0);
  }
  return static_cast<Index>(k);
}

std::array<Pair, 2> Contacts::pairs_of(Index l) const {
  const Link& link = sample_.links[l];
  const Image image = sample_.link_image.empty() ? Image{0, 0} : sample_.link_image[l];
  return {Pair{link.a, cell_of_[link.b], 0, 0, opposite(image)}, Pair{link.b, cell_of_[link.a], 0, 0, image}};
}

double Contacts::pressing_across(Index l, const Field& x) const {
  double sum = 0;
  for (const Pair& across : pairs_of(l))
    if (const auto k = place_of(across)) {
      const Touch t = touch(list_, list_.pairs[*k], x);
      sum += t.k * t.overlap.energy;
    }
  return sum;
}

double Contacts::release(Index l, const Field& x, double f_t) {
  linked_.set_intact(l, 0);
  double held = 0;
  for (const Pair& across : pairs_of(l)) {
    const Index k = list_pair(across);
    if (p_.friction == 0) continue;
    // The link drags a by f_t t, and the contact by -k_t stretch T with T = -t; on b both signs turn.
    const Pair& pair = list_.pairs[k];
    const double k_t = tangential_stiffness(pair);
    dissipated_ += 0.5 * k_t * spring_[k].stretch * spring_[k].stretch;  // of another foot on that cell
    double clipped = 0;  // not dissipation of ours: the link has booked what it held
    spring_[k] = next_spring(pair, touch(list_, pair, x), x, k_t > 0 ? 0.5 * f_t / k_t : 0.0, clipped);
    spring_[k].force = k_t * spring_[k].stretch;
    trial_[k] = spring_[k];
    held += 0.5 * k_t * spring_[k].stretch * spring_[k].stretch;
  }
  return held;
}

}  // namespace lamella
