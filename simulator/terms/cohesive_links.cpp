#include "simulator/terms/cohesive_links.h"

#include <algorithm>
#include <numeric>

#include "simulator/laws/cohesive.h"

namespace lamella {

void LinkForces::resize(std::size_t n) {
  if (fx.size() >= n + 2) return;
  for (auto* v : {&fx, &fy, &gx, &gy, &f_n, &f_t, &dx, &dy, &cx, &cy}) v->resize(n + 2);
}

CohesiveLinks::CohesiveLinks(const ShellLayout& layout, LinkParameters parameters)
    : layout_(layout),
      sample_(layout.sample()),
      p_(std::move(parameters)),
      first_normal_stiffness_(p_.normal_stiffness),
      intact_(sample_.links.size(), 1) {
  if (breakable()) keep_break_times();
  if (!p_.normal_toughness.empty()) {
    zone_.resize(sample_.links.size());
    first_tangential_stiffness_ = p_.tangential_stiffness;
  }
  make_stations();
}

void CohesiveLinks::make_stations() {
  for (auto* indices : {&a_, &b_, &link_, &cell_b_, &first_, &last_, &block_begin_, &block_middle_, &farthest_node_})
    indices->clear();
  for (auto* values :
       {&k_n_, &k_t_, &offset_n_, &offset_t_, &image_x_, &image_y_, &inverse_strength_n_, &inverse_strength_t_})
    values->clear();
  const auto& links = standing_.empty() ? sample_.links : standing_;
  const auto cell_of = cell_of_node(sample_);
  const Index count = static_cast<Index>(links.size());
  const auto block = [&](Index node) { return layout_.block_of_cell(cell_of[node]); };
  const auto owner = [&](Index l) { return std::min(block(links[l].a), block(links[l].b)); };
  const auto leaves = [&](Index l) {
    return layout_.chunk_of_block(block(links[l].a)) != layout_.chunk_of_block(block(links[l].b)) ? 1 : 0;
  };
  std::vector<Index> order(count);
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](Index l, Index m) { return std::pair(owner(l), leaves(l)) < std::pair(owner(m), leaves(m)); });

  station_.assign(count, 0);
  const Index blocks = static_cast<Index>(layout_.blocks().size());
  block_begin_.assign(1, 0);
  Index at = 0;
  for (Index b = 0; b < blocks; ++b) {
    for (const int leaving : {0, 1}) {
      for (Index previous = -1; at < count && owner(order[at]) == b && leaves(order[at]) == leaving;
           previous = order[at++]) {
        const Index l = order[at];
        // The link before lends its nodes to the tangent, and this one lends its own to the link before.
        const bool continues = previous >= 0 && links[l].wall == links[previous].wall &&
                               links[l].a_prev == links[previous].a && links[l].b_next == links[previous].b &&
                               links[previous].a_next == links[l].a && links[previous].b_prev == links[l].b;
        add_stations(l, continues);
      }
      if (!last_.empty()) last_.back() = 1;
      if (leaving == 0) block_middle_.push_back(static_cast<Index>(a_.size()));
    }
    block_begin_.push_back(static_cast<Index>(a_.size()));
  }
  for (const Index b : b_) cell_b_.push_back(cell_of[b]);
  Index farthest = 0;
  for (Index b = 0; b < blocks; ++b) {
    for (Index i = begin(b); i < end(b); ++i) farthest = std::max({farthest, a_[i], b_[i]});
    farthest_node_.push_back(farthest);
  }
  if (!sample_.link_image.empty())
    for (const Index l : link_) {
      const Vec2 steps = l < 0 ? Vec2(0, 0) : steps_of(sample_.link_image[l]);
      image_x_.push_back(steps.x()), image_y_.push_back(steps.y());
    }
  if (breakable()) {
    for (const Index l : link_) {
      inverse_strength_n_.push_back(l < 0 ? 0.0 : 1 / p_.normal_strength[l]);
      inverse_strength_t_.push_back(l < 0 ? 0.0 : 1 / p_.tangential_strength[l]);
    }
  }
}

// A run starts with a pair (a_prev, b_next) where the first link's tangent reaches back, and ends with (a_next, b_prev) where
// the last one's reaches on; such pairs carry no link themselves.
void CohesiveLinks::add_stations(Index l, bool continues) {
  const Link& link = this->link(l);
  const auto add = [&](Index a, Index b, Index carried) {
    a_.push_back(a), b_.push_back(b), link_.push_back(carried), first_.push_back(0), last_.push_back(0);
    k_n_.push_back(carried < 0 ? 0.0 : p_.normal_stiffness[carried]);
    k_t_.push_back(carried < 0 ? 0.0 : p_.tangential_stiffness[carried]);
    offset_n_.push_back(carried < 0 ? 0.0 : link.offset_n);
    offset_t_.push_back(carried < 0 ? 0.0 : link.offset_t);
  };
  if (continues) {
    // The link before has left a pair (a_next, b_prev) = (a, b) behind itself: it becomes this link's station.
    a_.pop_back(), b_.pop_back(), link_.pop_back(), first_.pop_back(), last_.pop_back();
    k_n_.pop_back(), k_t_.pop_back(), offset_n_.pop_back(), offset_t_.pop_back();
  } else {
    if (!last_.empty()) last_.back() = 1;
    const bool reaches_back = link.a_prev != link.a || link.b_next != link.b;
    if (reaches_back) {
      add(link.a_prev, link.b_next, -1);
      first_.back() = 1;
    }
  }
  const bool starts = !continues && (link.a_prev == link.a && link.b_next == link.b);
  station_[l] = static_cast<Index>(a_.size());
  add(link.a, link.b, l);
  if (starts) first_.back() = 1;
  if (link.a_next != link.a || link.b_prev != link.b) add(link.a_next, link.b_prev, -1);
}

Vec2 CohesiveLinks::middle_of(Index l, const Field& x) const {
  return 0.5 * (x.at(sample_.links[l].a) + x.at(sample_.links[l].b) + displaced(l, x));
}

CohesiveLinks::State CohesiveLinks::state(const Field& x, Index l) const {
  const Link& link = this->link(l);
  State s;
  s.d = x.at(link.b) - x.at(link.a);
  if (!sample_.link_image.empty()) s.d += displaced(l, x);
  if (box_moves(sample_, x)) s.box = sample_.nodes();
  const Vec2 tau = (x.at(link.a_next) - x.at(link.a_prev)) - (x.at(link.b_next) - x.at(link.b_prev));
  s.tau = tau.norm();
  s.t = tau / s.tau;
  s.n = right_of(s.t);
  s.u_n = s.d.dot(s.n) - link.offset_n;
  s.u_t = s.d.dot(s.t) - link.offset_t;
  s.k_nn = p_.normal_stiffness[l], s.k_tt = p_.tangential_stiffness[l];
  s.f_n = s.k_nn * s.u_n;
  s.f_t = s.k_tt * s.u_t;
  s.potential = s.stored = 0.5 * s.f_n * s.u_n + 0.5 * s.f_t * s.u_t;
  if (softens() && intact_[l]) respond(l, s);
  s.moment = s.f_n * s.d.dot(s.t) - s.f_t * s.d.dot(s.n);
  return s;
}

double CohesiveLinks::zeta_of(Index l, const State& s) const {
  return yield_function(p_.normal_stiffness[l] * s.u_n, p_.tangential_stiffness[l] * s.u_t, p_.normal_strength[l],
                        p_.tangential_strength[l], p_.exponent);
}

double CohesiveLinks::energy(const Field& x) const {
  double sum = 0;
  for (Index l = 0; l < static_cast<Index>(sample_.links.size()); ++l) {
    if (intact_[l]) sum += state(x, l).potential;
  }
  return sum;
}

// d(phi) = left_of(t) . d(tau) / |tau| turns the frame by phi, so a node that enters tau with weight w gets the force
// -w M left_of(t) / |tau| = w M n / |tau|; G = -M n / |tau|.
bool CohesiveLinks::evaluate(const Field& x, Index first, Index last, LinkForces& out) const {
  const Index count = last - first;
  if (count == 0) return false;
  out.resize(count);
  const double *X = x.x.data(), *Y = x.y.data();
  const Index *A = a_.data() + first, *B = b_.data() + first;
  double *DX = out.dx.data() + 1, *DY = out.dy.data() + 1, *CX = out.cx.data() + 1, *CY = out.cy.data() + 1;
  for (Index i = 0; i < count; ++i) {
    const double ax = X[A[i]], ay = Y[A[i]], bx = X[B[i]], by = Y[B[i]];
    DX[i] = bx - ax, DY[i] = by - ay, CX[i] = bx + ax, CY[i] = by + ay;
  }
  if (!image_x_.empty()) {
    const Vec2 box = box_size(sample_, x);
    const double *IX = image_x_.data() + first, *IY = image_y_.data() + first, lx = box.x(), ly = box.y();
    for (Index i = 0; i < count; ++i) DX[i] += IX[i] * lx, DY[i] += IY[i] * ly;
  }
  const Index *START = first_.data() + first, *STOP = last_.data() + first;
  const double *KN = k_n_.data() + first, *KT = k_t_.data() + first;
  const double *ON = offset_n_.data() + first, *OT = offset_t_.data() + first;
  double *FX = out.fx.data() + 1, *FY = out.fy.data() + 1, *GX = out.gx.data() + 1, *GY = out.gy.data() + 1;
  double *FN = out.f_n.data() + 1, *FT = out.f_t.data() + 1;
#pragma omp simd
  for (Index i = 0; i < count; ++i) {
    const double tx = (STOP[i] ? CX[i] : CX[i + 1]) - (START[i] ? CX[i] : CX[i - 1]);
    const double ty = (STOP[i] ? CY[i] : CY[i + 1]) - (START[i] ? CY[i] : CY[i - 1]);
    const double il = 1.0 / std::sqrt(tx * tx + ty * ty + 1e-300);
    const double cx = tx * il, cy = ty * il;  // t; n = (cy, -cx)
    const double dn = DX[i] * cy - DY[i] * cx, dt = DX[i] * cx + DY[i] * cy;
    const double fn = KN[i] * (dn - ON[i]), ft = KT[i] * (dt - OT[i]);
    const double g = -(fn * dt - ft * dn) * il;
    FN[i] = fn, FT[i] = ft;
    FX[i] = fn * cy + ft * cx, FY[i] = ft * cy - fn * cx;
    GX[i] = g * cy, GY[i] = -g * cx;
  }
  if (!breakable()) return false;
  if (softens()) return soften(x, first, last, out);
  const double *SN = inverse_strength_n_.data() + first, *ST = inverse_strength_t_.data() + first;
  double worst = -1;
  if (p_.exponent == 2) {
#pragma omp simd reduction(max : worst)
    for (Index i = 0; i < count; ++i) {
      const double shear = FT[i] * ST[i];
      worst = std::max(worst, FN[i] * SN[i] + shear * shear - 1);
    }
  } else {
    for (Index i = 0; i < count; ++i)
      if (SN[i] > 0) worst = std::max(worst, yield_function(FN[i], FT[i], 1 / SN[i], 1 / ST[i], p_.exponent));
  }
  return worst >= 0;
}

void CohesiveLinks::prefetch_stations(Index first, Index last) const {
  for (const auto* indices : {&a_, &b_, &first_, &last_}) prefetch(*indices, first, last);
  for (const auto* values : {&k_n_, &k_t_, &offset_n_, &offset_t_}) prefetch(*values, first, last);
  if (!image_x_.empty()) prefetch(image_x_, first, last), prefetch(image_y_, first, last);
  if (!breakable()) return;
  prefetch(inverse_strength_n_, first, last);
  prefetch(inverse_strength_t_, first, last);
}

Break CohesiveLinks::broken_at(const Field& x, Index l) const {
  const State s = state(x, l);
  const double k_n = p_.normal_stiffness[l], k_t = p_.tangential_stiffness[l];
  Break event;
  event.link = l;
  event.f_n = s.f_n, event.f_t = s.f_t;
  event.position = middle_of(l, x);
  event.energy = softens() ? s.potential + dissipated(l)
                           : 0.5 * (k_n > 0 ? s.f_n * s.f_n / k_n : 0.0) + 0.5 * (k_t > 0 ? s.f_t * s.f_t / k_t : 0.0);
  // A pressed pair keeps its normal force: contact takes over what the link held.
  if (p_.contact_after && s.f_n < 0 && p_.friction > 0)
    event.friction_force = std::clamp(s.f_t, p_.friction * s.f_n, -p_.friction * s.f_n);
  event.energy -= left_to_contact(event, x) + left_to_friction(event);
  return event;
}

double CohesiveLinks::left_to_contact(const Break& event, const Field& x) const {
  if (!p_.contact_after || event.f_n >= 0) return 0;
  const State s = state(x, event.link);
  const double closed = std::min(0.0, s.d.dot(s.n) - sample_.links[event.link].offset_n);
  return 0.5 * first_normal_stiffness_[event.link] * closed * closed;
}

double CohesiveLinks::left_to_friction(const Break& event) const {
  if (event.friction_force == 0) return 0;
  return 0.5 * event.friction_force * event.friction_force /
         (p_.tangential_ratio * first_normal_stiffness_[event.link]);
}

void CohesiveLinks::remove_stiffness(Index l) {
  p_.normal_stiffness[l] = p_.tangential_stiffness[l] = 0;
  k_n_[station_[l]] = k_t_[station_[l]] = 0;
}

void CohesiveLinks::break_exceeded(const Field& x, Index first, Index last, LinkForces& out,
                                   std::vector<Break>& breaks) {
  if (softens()) return commit_damage(x, first, out, breaks);
  for (Index i = first; i < last; ++i) {
    const Index at = i - first + 1, l = link_[i];
    if (l < 0 || !intact_[l]) continue;
    if (yield_function(out.f_n[at], out.f_t[at], p_.normal_strength[l], p_.tangential_strength[l], p_.exponent) < 0)
      continue;
    take_out(x, l, at, out, breaks);
  }
}

CohesiveLinks::Loaded CohesiveLinks::most_loaded(const Field& x, LinkForces& work) const {
  Loaded most;
  if (!breakable() || softens()) return most;
  const Index count = static_cast<Index>(a_.size());
  evaluate(x, 0, count, work);
  for (Index i = 0; i < count; ++i) {
    const Index l = link_[i];
    if (l < 0 || !intact_[l]) continue;
    const double zeta =
        yield_function(work.f_n[i + 1], work.f_t[i + 1], p_.normal_strength[l], p_.tangential_strength[l], p_.exponent);
    if (zeta > most.zeta) most = {zeta, l};
  }
  return most;
}

Break CohesiveLinks::break_at_rest(Index l, const Field& x) {
  const Break event = broken_at(x, l);
  intact_[l] = 0;
  remove_stiffness(l);
  return event;
}

void CohesiveLinks::take_out(const Field& x, Index l, Index at, LinkForces& out, std::vector<Break>& breaks) {
  const State s = state(x, l);
  Break event = broken_at(x, l);
  const double f_n_after = p_.contact_after && s.f_n < 0 ? s.f_n : 0.0;
  const double f_n = 0.5 * (s.f_n + f_n_after), f_t = 0.5 * (s.f_t + event.friction_force);
  const Vec2 mean = f_n * s.n + f_t * s.t;
  // The couple of the mean forces goes to the frame, so that angular momentum is kept in this step too.
  const double moment = f_n * s.d.dot(s.t) - f_t * s.d.dot(s.n);
  const double share = s.moment != 0 ? moment / s.moment : 0.0;
  event.dropped_force = Vec2(out.fx[at], out.fy[at]) - mean;
  event.dropped_frame_force = (1 - share) * Vec2(out.gx[at], out.gy[at]);
  breaks.push_back(event);
  out.fx[at] = mean.x(), out.fy[at] = mean.y();
  out.gx[at] *= share, out.gy[at] *= share;
  intact_[l] = 0;
  remove_stiffness(l);
}

std::vector<Index> CohesiveLinks::without_tangent(const BrokenBars& broken) const {
  std::vector<Index> out;
  for (Index l = 0; l < static_cast<Index>(sample_.links.size()); ++l)
    if (intact_[l] && !has_tangent(with_standing_tangent(sample_.links[l], broken))) out.push_back(l);
  return out;
}

Break CohesiveLinks::cut(Index l, const Field& x, const Field& later) {
  Break event = broken_at(x, l);
  event.energy = 0.5 * (state(x, l).potential + state(later, l).potential) + dissipated(l);
  intact_[l] = 0;
  remove_stiffness(l);
  return event;
}

void CohesiveLinks::follow(const BrokenBars& broken) {
  standing_.clear();
  for (const Link& link : sample_.links) standing_.push_back(with_standing_tangent(link, broken));
  make_stations();
}

void CohesiveLinks::commit(const Field& x) {
  breaks_.clear();
  if (!breakable()) return;
  LinkForces forces;
  const Index count = static_cast<Index>(a_.size());
  if (evaluate(x, 0, count, forces)) break_exceeded(x, 0, count, forces, breaks_);
}

// A station gets -G from the one before (it is that one's next) and +G from the one behind; at the ends of a run, where the stencil
// stops at the station itself, those are its own.
void CohesiveLinks::combine(Index first, Index last, LinkForces& w) const {
  const Index count = last - first;
  const Index *START = first_.data() + first, *STOP = last_.data() + first;
  const double *FX = w.fx.data() + 1, *FY = w.fy.data() + 1, *GX = w.gx.data() + 1, *GY = w.gy.data() + 1;
  double *AX = w.cx.data() + 1, *AY = w.cy.data() + 1, *BX = w.dx.data() + 1, *BY = w.dy.data() + 1;
#pragma omp simd
  for (Index i = 0; i < count; ++i) {
    const double hx = (START[i] ? GX[i] : -GX[i - 1]) + (STOP[i] ? -GX[i] : GX[i + 1]);
    const double hy = (START[i] ? GY[i] : -GY[i - 1]) + (STOP[i] ? -GY[i] : GY[i + 1]);
    AX[i] = hx + FX[i], AY[i] = hy + FY[i];
    BX[i] = hx - FX[i], BY[i] = hy - FY[i];
  }
}

void CohesiveLinks::scatter_a(const LinkForces& w, Index at, Index first, Index last, Field& f) const {
  const double *AX = w.cx.data() + 1 + at, *AY = w.cy.data() + 1 + at;
  for (Index i = first; i < last; ++i) f.x[a_[i]] += AX[i - first], f.y[a_[i]] += AY[i - first];
}

void CohesiveLinks::scatter_b(const LinkForces& w, Index at, Index first, Index last, Field& f) const {
  const double *BX = w.dx.data() + 1 + at, *BY = w.dy.data() + 1 + at;
  for (Index i = first; i < last; ++i) f.x[b_[i]] += BX[i - first], f.y[b_[i]] += BY[i - first];
}

void CohesiveLinks::scatter(const LinkForces& w, Index first, Index last, Field& f) const {
  const double *AX = w.cx.data() + 1, *AY = w.cy.data() + 1, *BX = w.dx.data() + 1, *BY = w.dy.data() + 1;
  const Index *A = a_.data() + first, *B = b_.data() + first, count = last - first;
  double *FX = f.x.data(), *FY = f.y.data();
  for (Index i = 0; i < count; ++i) {
    FX[A[i]] += AX[i], FY[A[i]] += AY[i];
    FX[B[i]] += BX[i], FY[B[i]] += BY[i];
  }
}

void CohesiveLinks::add_force(const Field& x, Field& f) const {
  LinkForces forces;
  const Index count = static_cast<Index>(a_.size());
  evaluate(x, 0, count, forces);
  combine(0, count, forces);
  scatter(forces, 0, count, f);
  if (box_moves(sample_, x)) f.add(sample_.nodes(), force_on_box(0, count, forces));
}

// The force on b is -F, and the box displaces b by its steps.
Vec2 CohesiveLinks::force_on_box(Index first, Index last, const LinkForces& w) const {
  Vec2 sum = Vec2::Zero();
  if (image_x_.empty()) return sum;
  for (Index i = first; i < last; ++i) {
    sum.x() -= image_x_[i] * w.fx[i - first + 1];
    sum.y() -= image_y_[i] * w.fy[i - first + 1];
  }
  return sum;
}

// In the coordinates q = (D, tau): with c_D, c_tau the weights of a node in D and tau, its block with another node is
// sum c c' d2W/dq dq'.
void CohesiveLinks::add_stiffness(const Field& x, StiffnessSink& sink) const {
  const std::vector<Index> cell = cell_of_node(sample_);
  for (Index l = 0; l < static_cast<Index>(sample_.links.size()); ++l)
    if (intact_[l] && sink.begin_elements(cell[sample_.links[l].a])) add_stiffness_of(l, x, sink);
}

void CohesiveLinks::add_stiffness_of(Index l, const Field& x, StiffnessSink& sink) const {
  add_stiffness_of(l, state(x, l), sink);
}

void CohesiveLinks::add_stiffness_of(Index l, const State& s, StiffnessSink& sink) const {
  const Link& link = this->link(l);
  const double d_n = s.d.dot(s.n), d_t = s.d.dot(s.t);
  const Vec2 phi = -s.n / s.tau;  // d(phi)/d(tau); left_of(t) = -n
  // u_n: d/dD = n, d/dphi = D_t; u_t: d/dD = t, d/dphi = -D_n
  const double w_phi_phi = s.k_nn * d_t * d_t + s.k_tt * d_n * d_n - 2 * s.k_nt * d_n * d_t - s.f_n * d_n - s.f_t * d_t;
  const Vec2 w_d_phi = (s.k_nn * d_t - s.k_nt * d_n - s.f_t) * s.n + (-s.k_tt * d_n + s.k_nt * d_t + s.f_n) * s.t;
  const Eigen::Matrix2d dd = s.k_nn * s.n * s.n.transpose() + s.k_tt * s.t * s.t.transpose() +
                             s.k_nt * (s.n * s.t.transpose() + s.t * s.n.transpose());
  const Eigen::Matrix2d d_tau = w_d_phi * phi.transpose();
  // d2(phi)/d(tau)2 = -(t m^T + m t^T) / |tau|^2 with m = left_of(t) = -n
  const Eigen::Matrix2d tau_tau =
      w_phi_phi * phi * phi.transpose() + s.moment / (s.tau * s.tau) * (s.t * s.n.transpose() + s.n * s.t.transpose());
  struct Role {
    Index node;
    double d, tau;
  };
  const Role roles[6] = {{link.a, -1, 0},      {link.b, 1, 0},       {link.a_next, 0, 1},
                         {link.a_prev, 0, -1}, {link.b_next, 0, -1}, {link.b_prev, 0, 1}};
  // A node has a weight in D or in tau, never in both.
  const Eigen::Matrix2d tau_d = d_tau.transpose();
  for (const Role& p : roles)
    for (const Role& q : roles) {
      const Eigen::Matrix2d& block = p.d != 0 ? (q.d != 0 ? dd : d_tau) : (q.d != 0 ? tau_d : tau_tau);
      sink.add(p.node, q.node, ((p.d + p.tau) * (q.d + q.tau)) * block);
    }
  if (s.box < 0 || sample_.link_image[l] == Image{0, 0}) return;
  // The box displaces b by its steps: it has b's weight in D, times those.
  const Eigen::DiagonalMatrix<double, 2> steps(steps_of(sample_.link_image[l]));
  for (const Role& q : roles) {
    const Eigen::Matrix2d block = (q.d + q.tau) * (steps * (q.d != 0 ? dd : d_tau));
    sink.add(s.box, q.node, block), sink.add(q.node, s.box, block.transpose());
  }
  sink.add(s.box, s.box, steps * dd * steps);
}

double CohesiveLinks::mode_mix_of(const Break& b) const {
  if (!breakable()) return 0;
  if (softens() && zone_[b.link].end > zone_[b.link].onset) return zone_mode_mix(zone_link(b.link), zone_[b.link]);
  return mode_mix(b.f_n, b.f_t, p_.normal_strength[b.link], p_.tangential_strength[b.link]);
}

std::optional<Index> CohesiveLinks::crushed(const Field& x) const {
  for (Index l = 0; l < static_cast<Index>(sample_.links.size()); ++l) {
    if (!intact_[l] || !(sample_.links[l].offset_n > 0)) continue;
    const State s = state(x, l);
    if (s.d.dot(s.n) <= 0) return l;
  }
  return std::nullopt;
}

Index CohesiveLinks::broken() const { return static_cast<Index>(std::count(intact_.begin(), intact_.end(), 0)); }

void CohesiveLinks::save(ArraySet& restart) const {
  restart.add({"link_intact", "1", "link", 1, std::vector<std::int32_t>(intact_.begin(), intact_.end())});
  if (!break_time_.empty()) restart.add({"link_break_time", "s", "link", 1, break_time_});
  if (softens()) save_damage(restart);
}

void CohesiveLinks::restore(const ArraySet& restart) {
  if (!restart.find("link_intact")) return;
  const auto& intact = restart.ints("link_intact");
  intact_.assign(intact.begin(), intact.end());
  for (std::size_t l = 0; l < intact_.size(); ++l)
    if (!intact_[l]) remove_stiffness(static_cast<Index>(l));
  if (!break_time_.empty() && restart.find("link_break_time")) break_time_ = restart.doubles("link_break_time");
  restore_damage(restart);
}

void CohesiveLinks::add_output(const Field& x, ArraySet& frame) const {
  const std::size_t n = sample_.links.size();
  std::vector<double> force(2 * n), energy(n), zeta(breakable() ? n : 0), damage(softens() ? n : 0, 1.0);
  for (Index l = 0; l < static_cast<Index>(n); ++l) {
    if (!intact_[l]) continue;
    const State s = state(x, l);
    force[2 * l] = s.f_n, force[2 * l + 1] = s.f_t;
    energy[l] = s.stored;
    if (softens()) damage[l] = s.damage;
    if (breakable()) zeta[l] = zeta_of(l, s);
  }
  frame.add({"link_force", "N", "link", 2, std::move(force)});
  frame.add({"link_energy", "J", "link", 1, std::move(energy)});
  frame.add({"link_intact", "1", "link", 1, std::vector<std::int32_t>(intact_.begin(), intact_.end())});
  if (!break_time_.empty()) frame.add({"link_break_time", "s", "link", 1, break_time_});
  if (!breakable()) return;
  frame.add({"link_zeta", "1", "link", 1, std::move(zeta)});
  frame.add({"link_w0", "J", "link", 1, p_.full_energy});
  if (softens()) frame.add({"link_damage", "1", "link", 1, std::move(damage)});
}

std::size_t CohesiveLinks::bytes() const {
  return a_.size() * (6 * sizeof(Index) + (breakable() ? 6 : 4) * sizeof(double)) +
         intact_.size() * (sizeof(Index) + 1 + (breakable() ? 7 : 3) * sizeof(double)) +
         (image_x_.size() + image_y_.size()) * sizeof(double) + standing_.size() * sizeof(Link) +
         zone_.size() * (sizeof(ZoneHistory) + 2 * sizeof(double));
}

}  // namespace lamella
