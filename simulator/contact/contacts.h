// Contact: every node acts on the closest points of every other shell, and of its own shell further along.
//
// A node pushes with half of its own k_n, because what it touches pushes back through nodes of its own (with the full k_n against a
// *bare* shell, whose nodes seek nothing): two walls hold the same energy whether their nodes face each other or not, and cells of
// different stiffness meet with the mean of both. Feet are in feet.h, how several add up in overlap.h, friction in friction.h, the search
// in candidates.h.
#pragma once
#include <array>
#include <optional>
#include <utility>

#include "simulator/contact/candidates.h"
#include "simulator/contact/drift.h"
#include "simulator/contact/friction.h"
#include "simulator/contact/overlap.h"
#include "simulator/moving_box.h"
#include "simulator/terms/term.h"

namespace lamella {

struct ContactParameters {
  std::vector<double> node_stiffness;  // k_n of each node: stiffness per length times tributary length [N/m]
  std::vector<double> node_mass;       // for the dashpots [kg]; empty without damping
  double friction = 0;                 // mu
  double tangential_ratio = 0.1;       // of the friction spring's stiffness to k_n
  double damping = 0;                  // of the normal dashpots, as a fraction of critical
  double skin = 0;                     // of the candidate list [m]; 0: chosen
  std::vector<std::uint8_t>
      bare;  // per cell: others press with their full stiffness, its own nodes seek no feet; empty: none
};

class Contacts final : public Term {
 public:
  /// All links of the sample count as broken until `set_intact`.
  Contacts(const Sample& sample, ContactParameters parameters, const Field& x0);
  Contacts(const Contacts&) = delete;  // rules_ refers to its neighbours

  std::string name() const override { return "contacts"; }
  double energy(const Field& x) const override;
  void add_force(const Field& x, Field& f) const override;
  void add_stiffness(const Field& x, StiffnessSink& sink) const override;
  void commit(const Field& x) override;
  void save(ArraySet& restart) const override;
  /// Takes the friction springs, and from `link_intact` which links are gone.
  void restore(const ArraySet& restart) override;
  void add_output(const Field& x, ArraySet& frame) const override;
  std::size_t bytes() const override;

  // ---- the stepper's path: candidates, evaluate (in parts, in parallel), scatter, advance ----
  /// Makes sure that every pair of node and cell is listed that can touch before some node has moved by half of skin() from
  /// here. Makes a new list only when neighbours have moved against each other, and never changes a result.
  void update_candidates(const Field& x);
  /// Whether the present list holds every pair that can touch at x.
  bool covers(const Field& x) const;
  /// How much of `way` [m] all nodes can go from x, on straight lines, such that no wall can have passed through another, in (0, 1].
  double safe_share(const Field& x, const Field& way);
  /// Makes the list of candidates anew, however good the present one.
  void rebuild(const Field& x);
  double skin() const { return 0.5 * rules_.skin; }
  /// Steps of the farthest image that a cell may meet, where the box moves.
  double farthest_image() const { return drift_.farthest_image(); }
  /// k_n of a node that presses on a bare shell [N/m].
  double node_stiffness(Index node) const { return p_.node_stiffness[node]; }
  /// Number of listed pairs.
  Index active() const { return static_cast<Index>(list_.pairs.size()); }
  /// Forces of pairs [begin, end), kept per pair. Ranges that do not overlap may be evaluated at the same time.
  void evaluate(const Field& x, const Field& v, Index begin, Index end);
  /// Adds what `evaluate` found, by node, then cell: springs into f, dashpots into damped_f (not touched without damping).
  void scatter(Field& f, Field& damped_f) const;
  /// Moves the friction springs to where the last `evaluate` was.
  void advance();
  double stored_in_friction() const;                          // [J]
  double friction_dissipated() const { return dissipated_; }  // since the beginning, through restarts [J]

  // ---- links ----
  /// The two nodes of this link ignore the segments that meet at each other.
  void set_intact(Index link);
  /// What the two nodes of this link press each other's cell with, instead of their own k_n [N/m].
  void set_pair_stiffness(Index link, double k_n);
  /// The link is gone: from now on contact, whose friction springs start at f_t (clipped to mu f_n), half on each side. Returns what
  /// these springs hold [J].
  double release(Index link, const Field& x, double f_t);
  /// With what energy the two nodes of this link press each other's cell at x, by the rules as they are now [J].
  double pressing_across(Index link, const Field& x) const;

  // ---- broken bars ----
  /// Bars that are gone touch nothing; `broken` must outlive this. Before the first step, or with `lose`.
  void watch(const BrokenBars& broken) { rules_.broken = &broken, stale_ = true; }
  /// One of the bars that are watched is gone, now that nodes are at x; what was anchored to it goes with it.
  void lose(Index bar, const Field& x);

  /// A node inside a closed cell where it was not at the beginning, or a wall across a chain: an unsigned distance pushes the wrong way.
  std::optional<std::string> fault(const Field& x) const;

  // ---- for the stable time step ----
  /// Stiffness as if every listed pair touched, so that a new contact cannot surprise the step.
  void add_possible_stiffness(const Field& x, StiffnessSink& sink) const;
  /// The same for the dashpots [N s/m].
  void add_possible_damping(const Field& x, StiffnessSink& sink) const;

 private:
  /// Force on a node and, with the opposite sign and the weights of a foot, on a segment.
  struct FootForce {
    Index segment = 0, next = 0;
    double t = 0;
    Vec2 force{0, 0};    // on the node [N]
    Vec2 couple{0, 0};   // on `next`, and its opposite on `segment` [N]
    Vec2 damping{0, 0};  // on the node [N]
  };
  /// An entry of the field that displaces a node by its steps; -1: none does.
  struct BoxEntry {
    Index node = -1;
    Vec2 steps{0, 0};
  };
  using Outcome = std::array<FootForce, kMaxFeet + 1>;  // the last for friction
  struct Touch {
    Feet feet;
    Overlap overlap;
    double k = 0;  // [N/m]
  };

  double stiffness(const Pair& pair) const;
  double tangential_stiffness(const Pair& pair) const { return p_.tangential_ratio * stiffness(pair); }
  double reach(const Pair& pair) const;
  /// Where the node of the pair is, seen from its cell, beside x [m].
  Vec2 shift(const Pair& pair, const Field& x) const { return displacement(pair.image, box_size(sample_, x)); }
  Slip slip(const FrictionSpring& spring, const Field& x, const Pair& pair) const {
    return slip_of(spring, x, pair.node, shift(pair, x));
  }
  /// The box that displaces the node of the pair, where it moves.
  BoxEntry box_of(const Pair& pair, const Field& x) const {
    return box_moves(sample_, x) && pair.image != Image{0, 0} ? BoxEntry{sample_.nodes(), steps_of(pair.image)}
                                                              : BoxEntry{};
  }
  /// The pairs of the two nodes of a link with the other's cell, a's first; unlisted.
  std::array<Pair, 2> pairs_of(Index link) const;
  double dashpot(const Pair& pair) const;
  Touch touch(const CandidateList& list, const Pair& pair, const Field& x) const;
  Sliding sliding(Index pair, const Slip& slip) const;
  FrictionSpring next_spring(const Pair& pair, const Touch& touch, const Field& x, double stretch,
                             double& dissipated) const;
  void evaluate_friction(Index pair, const Touch& touch, const Field& x);
  template <class Visit>
  void for_each_touch(const Field& x, Visit visit) const;
  template <class Visit>
  void for_each_spring(Visit visit) const;
  std::optional<Index> place_of(const Pair& pair) const;
  Index list_pair(const Pair& pair);
  struct Inside {
    Index node = 0, cell = 0;
    Image image{0, 0};  // of the node, seen from the cell
    auto operator<=>(const Inside&) const = default;
  };
  std::vector<Inside> nodes_inside(const Field& x) const;
  bool opened(Index cell) const { return rules_.broken && rules_.broken->opened(cell); }

  const Sample& sample_;
  ContactParameters p_;
  std::vector<Index> cell_of_;
  SelfReach self_reach_;
  LinkedNodes linked_;
  CandidateRules rules_;
  std::vector<double> pair_stiffness_;  // per link [N/m]; empty until one is set
  std::vector<Inside> inside_;          // from the beginning, sorted

  Drift drift_;         // since the list was made
  bool stale_ = false;  // the rules have changed since
  CandidateList list_;
  // per pair
  std::vector<std::uint8_t> forces_;  // how many of outcome_ count
  std::vector<Outcome> outcome_;
  std::vector<FrictionSpring> spring_, trial_;  // committed, and where the last `evaluate` was; empty without friction
  std::vector<double> slid_;                    // what the move from spring_ to trial_ dissipates [J]; likewise
  double dissipated_ = 0;                       // [J]
};

template <class Visit>
void Contacts::for_each_touch(const Field& x, Visit visit) const {
  const bool listed = covers(x);
  const CandidateList elsewhere = listed ? CandidateList{} : find_candidates(rules_, x);
  const CandidateList& list = listed ? list_ : elsewhere;
  for (const Pair& pair : list.pairs) {
    const Touch t = touch(list, pair, x);
    if (t.feet.count > 0) visit(pair, t);
  }
}

template <class Visit>
void Contacts::for_each_spring(Visit visit) const {
  for (Index k = 0; k < static_cast<Index>(spring_.size()); ++k)
    if (spring_[k].acts()) visit(k, list_.pairs[k], spring_[k]);
}

}  // namespace lamella
