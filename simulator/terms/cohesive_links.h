// Cohesive links between facing nodes of two cells: W = 1/2 k_n (D.n - o_n)^2 + 1/2 k_t (D.t - o_t)^2 with D = x_b - x_a and the
// frame of the current interface, t along tau = (x_a+ - x_a-) - (x_b+ - x_b-). The frame is differentiated too: a link
// of finite length that carries f_t turns its walls by the couple f_t D_n, and a rigid rotation creates no force. In a periodic sample
// x_b is that of the image which faces a: the image displaces b, and drops out of tau.
//
// WHERE DOES A LINK BREAK? In `break_exceeded`, here, and nowhere else. Whether it should is `yield_function` in laws/cohesive.h. Links that
// soften before they break (laws/cohesive_zone.h) keep a history; what they need beyond the rest is in cohesive_links_damage.cpp.
#pragma once
#include <cstdint>
#include <optional>

#include "generator/sample/broken_bars.h"
#include "simulator/laws/cohesive_zone.h"
#include "simulator/moving_box.h"
#include "simulator/shells.h"
#include "simulator/terms/term.h"

namespace lamella {

/// Per link of the sample.
struct LinkParameters {
  std::vector<double> normal_stiffness, tangential_stiffness;  // k_n, k_t [N/m]
  std::vector<double> normal_strength, tangential_strength;    // [N]; both empty: links never break
  std::vector<double> full_energy;                             // W_0 of a link of one full spacing [J]; empty likewise
  double exponent = 2;                                         // alpha
  // Cohesive zone: energy of a whole link in pure opening and in pure shear [J]; 0: a brittle one. Both empty: all are brittle.
  std::vector<double> normal_toughness, tangential_toughness;
  ModeMixing mixing = ModeMixing::kBenzeggaghKenane;
  double mixing_exponent = 2;
  // What remains of a pair once its link is gone: contact of the link's own normal stiffness, and friction.
  bool contact_after = false;
  double friction = 0;          // mu
  double tangential_ratio = 0;  // of the friction spring to k_n
};

/// A link that has just broken.
struct Break {
  Index link = 0;
  double f_n = 0, f_t = 0;    // at the break [N]
  double friction_force = 0;  // f_t clipped to mu f_n, where the contact's friction spring starts [N]
  double energy = 0;  // link energy lost, what damage dissipated before included, less contact energy gained [J]
  Vec2 position = Vec2::Zero();  // [m]
  // What the step of the break leaves out of the full forces: on a (b has the opposite), and of G. The ledger weighs a
  // configuration before its breaks.
  Vec2 dropped_force = Vec2::Zero(), dropped_frame_force = Vec2::Zero();  // [N]
};

/// Forces at consecutive stations: F on a and -F on b, and G of the turning frame; padded by one zero in front and behind.
struct LinkForces {
  std::vector<double> fx, fy, gx, gy;
  std::vector<double> f_n, f_t;
  std::vector<double> dx, dy, cx, cy;  // scratch: x_b - x_a and x_b + x_a, then the sums on a and b
  std::vector<Index> advancing;        // stations whose damage grows; only of links that soften
  void resize(std::size_t n);
};

class CohesiveLinks final : public Term {
 public:
  CohesiveLinks(const ShellLayout& layout, LinkParameters parameters);

  std::string name() const override { return "links"; }
  double energy(const Field& x) const override;
  void add_force(const Field& x, Field& f) const override;
  void add_stiffness(const Field& x, StiffnessSink& sink) const override;
  /// Breaks every link whose criterion is exceeded at x, all judged on this one configuration. Breaks are kept in `breaks()`.
  void commit(const Field& x) override;
  /// The same of one link, intact or not [N/m].
  void add_stiffness_of(Index link, const Field& x, StiffnessSink& sink) const;
  void save(ArraySet& restart) const override;
  void restore(const ArraySet& restart) override;
  void add_output(const Field& x, ArraySet& frame) const override;
  std::size_t bytes() const override;

  // ---- the stepper's path. A *station* is a pair of facing nodes (a, b): every link, and at times a pair that only lends its
  // positions to a neighbour's tangent. Stations of a wall follow each other, so that tau at one is c(next) - c(previous) with
  // c = x_a + x_b: four loads a link instead of twelve, and contiguous ones. ----
  /// Stations owned by each block (that of their lower cell): [begin, middle) stay inside the block's chunk, [middle, end) leave it.
  Index begin(Index block) const { return block_begin_[block]; }
  Index middle(Index block) const { return block_middle_[block]; }
  Index end(Index block) const { return block_begin_[block + 1]; }
  /// Forces at stations [begin, end), result i - begin. Returns true if a link exceeds its criterion, or its damage grows.
  bool evaluate(const Field& x, Index begin, Index end, LinkForces& forces) const;
  /// Asks for what `evaluate` will read of stations [begin, end).
  void prefetch_stations(Index begin, Index end) const;
  /// Largest node that the stations of this block or of an earlier one touch.
  Index farthest_node(Index block) const { return farthest_node_[block]; }
  /// Breaks the exceeded links among [begin, end). The force of the step of the break becomes the mean of link and what
  /// follows it: the kick before the break and the one after it, which keeps the energy ledger second order in dt. Links that soften
  /// keep the damage that they have at x.
  void break_exceeded(const Field& x, Index begin, Index end, LinkForces& forces, std::vector<Break>& breaks);
  /// Turns the results of `evaluate` into the force on each station's a (in cx, cy) and b (in dx, dy).
  void combine(Index begin, Index end, LinkForces& forces) const;
  /// Force of stations [begin, end) on the lengths of a box that moves, from the results of `evaluate` [N].
  Vec2 force_on_box(Index begin, Index end, const LinkForces& forces) const;
  /// Adds combined forces to the nodes, one station after the other: the same sum for any number of threads.
  void scatter(const LinkForces& forces, Index begin, Index end, Field& f) const;
  /// The same for one side of stations [begin, end), whose results start at `at`.
  void scatter_a(const LinkForces& forces, Index at, Index begin, Index end, Field& f) const;
  void scatter_b(const LinkForces& forces, Index at, Index begin, Index end, Field& f) const;
  Index cell_b(Index station) const { return cell_b_[station]; }

  /// k_n of a link of the sample while it was intact [N/m].
  double normal_stiffness(Index link) const { return first_normal_stiffness_[link]; }
  bool breakable() const { return !p_.normal_strength.empty(); }
  bool softens() const { return !zone_.empty(); }
  /// What damage has dissipated in intact links up to the last commit [J]; of all of them, or of one.
  double dissipated() const;
  double dissipated(Index link) const { return softens() ? zone_dissipated(zone_[link]) : 0.0; }
  /// Whether damage would begin at x in a link that is beyond its criterion by more than this.
  bool begins_beyond(const Field& x, double zeta) const;
  /// s_max of each link [J^1/2]: how far its damage has come; empty where none softens.
  std::vector<double> damage_fronts() const;
  /// Length over which links like this one soften ahead of a crack in opening between walls of this bending rigidity [m], roughly; 0 where
  /// it is brittle.
  double zone_length(Index link, double bending) const;
  /// The stiffness as it would be without damage: how stiff a link can become again, by closing or unloading.
  void add_undamaged_stiffness(const Field& x, StiffnessSink& sink) const;
  bool intact(Index link) const { return intact_[link] != 0; }
  const std::vector<std::uint8_t>& intact() const { return intact_; }
  Index broken() const;
  void set_break_time(Index link, double time) { break_time_[link] = time; }
  double break_time(Index link) const { return break_time_[link]; }
  double mode_mix_of(const Break& event) const;
  /// What the pair's contact would hold at x if it began where the link was free of force: what the energy of the break leaves to
  /// contact in normal direction [J].
  double left_to_contact(const Break& event, const Field& x) const;
  /// The same in the friction springs, at the break [J].
  double left_to_friction(const Break& event) const;
  /// A link whose nodes have been pressed past each other (D.n <= 0), if any.
  std::optional<Index> crushed(const Field& x) const;
  // ---- at rest: one link at a time ----
  struct Loaded {
    double zeta = -1;
    Index link = -1;  // -1: none
  };
  /// The intact link that is nearest to its criterion at x, or furthest beyond it; none where links soften: those break in `commit`. `work`
  /// is scratch.
  Loaded most_loaded(const Field& x, LinkForces& work) const;
  /// The link is gone from now on, without the half forces of a step in time.
  Break break_at_rest(Index link, const Field& x);
  // ---- broken bars ----
  /// The link as it is now: its tangent holds only bars that stand.
  const Link& link(Index l) const { return standing_.empty() ? sample_.links[l] : standing_[l]; }
  /// Intact links that have no bar beside them any more, and so no frame.
  std::vector<Index> without_tangent(const BrokenBars& broken) const;
  /// Such a link is gone. Its forces are those at x; its energy is the mean of those at x and at `later`, as it still pulls in full.
  Break cut(Index link, const Field& x, const Field& later);
  /// From now on tangents keep to the bars that stand. Makes the stations anew.
  void follow(const BrokenBars& broken);
  /// Keeps times of breaks even where links have no strengths.
  void keep_break_times() { break_time_.resize(sample_.links.size(), -1.0); }
  /// Breaks of the last generic `commit`.
  const std::vector<Break>& breaks() const { return breaks_; }

 private:
  /// One link at x. M = f_n D_t - f_t D_n is conjugate to the rotation of the frame.
  struct State {
    Vec2 d, t, n;             // x_b - x_a and the frame
    double tau = 0;           // length of the tangent stencil [m]
    double u_n = 0, u_t = 0;  // openings D_n - o_n, D_t - o_t [m]
    double f_n = 0, f_t = 0, moment = 0;
    double potential = 0, stored = 0;     // as the term's energy, and without what damage dissipates in it [J]
    double k_nn = 0, k_nt = 0, k_tt = 0;  // second derivatives of the potential with respect to the openings [N/m]
    double damage = 0;
    bool advances = false;  // damage grows here
    Index box = -1;         // entry of the box, where it moves
  };
  State state(const Field& x, Index link) const;
  /// By which b is displaced where it faces a [m].
  Vec2 displaced(Index link, const Field& x) const {
    return sample_.link_image.empty() ? Vec2(0, 0) : displacement(sample_.link_image[link], box_size(sample_, x));
  }
  /// Of the forces without damage: it goes on growing while a link softens.
  double zeta_of(Index link, const State& s) const;
  /// Where the middle between its nodes is, beside a [m].
  Vec2 middle_of(Index link, const Field& x) const;
  Break broken_at(const Field& x, Index link) const;
  void make_stations();
  void add_stations(Index link, bool continues);
  void remove_stiffness(Index link);
  void take_out(const Field& x, Index link, Index at, LinkForces& forces, std::vector<Break>& breaks);
  void add_stiffness_of(Index link, const State& s, StiffnessSink& sink) const;
  // ---- links that soften: cohesive_links_damage.cpp ----
  ZoneLink zone_link(Index link) const;
  void respond(Index link, State& s) const;
  bool soften(const Field& x, Index begin, Index end, LinkForces& forces) const;
  void commit_damage(const Field& x, Index begin, LinkForces& forces, std::vector<Break>& breaks);
  void save_damage(ArraySet& restart) const;
  void restore_damage(const ArraySet& restart);

  const ShellLayout& layout_;
  const Sample& sample_;
  std::vector<Link> standing_;  // all links with the tangents that broken bars leave; empty: no bar is broken
  LinkParameters p_;            // of intact links; k_n and k_t go to 0 with the break
  std::vector<double> first_normal_stiffness_;     // k_n while the link was intact [N/m]
  std::vector<Index> block_begin_, block_middle_;  // stations, per block
  std::vector<Index> farthest_node_;               // per block
  // per station
  std::vector<Index> a_, b_, link_, cell_b_;  // link: -1 where the station carries none
  // Where a run of stations starts or ends the tangent is one-sided. As wide as an index: flags of a byte make g++ vectorise the
  // loops 64 stations at a time, which spills its registers and leaves most stations of a block to the scalar remainder.
  std::vector<Index> first_, last_;
  std::vector<double> k_n_, k_t_, offset_n_, offset_t_;
  std::vector<double> image_x_,
      image_y_;  // displacement of b, in lengths of the box; empty unless the sample is periodic
  std::vector<double> inverse_strength_n_, inverse_strength_t_;  // [1/N]; empty: links never break
  std::vector<Index> station_;                                   // of each link of the sample
  // per link of the sample
  std::vector<std::uint8_t> intact_;
  std::vector<ZoneHistory> zone_;                   // empty: no link softens
  std::vector<double> first_tangential_stiffness_;  // k_t while the link was intact [N/m]; empty likewise
  std::vector<double> break_time_;                  // [s], -1 while intact; empty: neither links nor bars break
  std::vector<Break> breaks_;
};

}  // namespace lamella
