#include "simulator/terms/wall_rupture.h"

#include <algorithm>
#include <limits>

namespace lamella {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

}  // namespace

WallRupture::WallRupture(const ShellLayout& layout, const WallStrength& strength, const Parts& parts)
    : layout_(layout), parts_(parts), broken_(layout.sample()), break_time_(layout.sample().nodes(), -1.0) {
  const Sample& s = layout.sample();
  const auto per_segment = [&](const std::vector<double>& of_cell, auto&& limit) {
    std::vector<double> out;
    if (of_cell.empty()) return out;
    out.assign(s.nodes(), kNever);
    for (Index c = 0; c < s.cells(); ++c)
      for (Index i = s.cell_begin[c]; i < s.cell_begin[c + 1]; ++i)
        if (s.starts_segment(c, i)) out[i] = limit(of_cell[c], i);
    return layout.padded(out, kNever);
  };
  force_ = per_segment(strength.force, [](double force, Index) { return force; });
  length_ = per_segment(strength.strain, [&](double strain, Index i) { return s.rest_length[i] * (1 + strain); });
}

bool WallRupture::exceeded(const ShellScratch& w) const {
  const Index n = w.block.slots, at = w.block.slot_begin;
  const double *T = w.tension.data(), *L = w.length.data();
  double worst = -1;
  if (!force_.empty()) {
    const double* F = force_.data() + at;
#pragma omp simd reduction(max : worst)
    for (Index s = 0; s < n; ++s) worst = std::max(worst, T[s] - F[s]);
  }
  if (!length_.empty() && worst < 0) {
    const double* MOST = length_.data() + at;
#pragma omp simd reduction(max : worst)
    for (Index s = 0; s < n; ++s) worst = std::max(worst, L[s] - MOST[s]);
  }
  return worst >= 0;
}

bool WallRupture::exceeds(Index slot, double tension, double length) const {
  return (!force_.empty() && tension >= force_[slot]) || (!length_.empty() && length >= length_[slot]);
}

void WallRupture::break_exceeded(const ShellScratch& w, const Drop& drop, std::vector<WallBreak>& breaks) const {
  const Sample& sample = layout_.sample();
  const auto halve = [&](Index node, const Vec2& force) { drop(node, 0.5 * force); };
  std::vector<Index> ended;  // hinges of the cell that are counted already
  for (Index c = w.block.cell_begin; c < w.block.cell_end; ++c) {
    ended.clear();
    bool first = true;
    for (Index i = sample.cell_begin[c]; i < sample.cell_begin[c + 1]; ++i) {
      const Index slot = ShellLayout::slot(c, i), at = slot - w.block.slot_begin;
      if (!sample.starts_segment(c, i) || !exceeds(slot, w.tension[at], w.length[at])) continue;
      const Index j = sample.next(c, i);
      WallBreak event;
      event.bar = i, event.cell = c;
      event.tension = w.tension[at];
      event.position = 0.5 * (Vec2(w.px[at], w.py[at]) + Vec2(w.px[at + 1], w.py[at + 1]));
      event.energy = parts_.bars->stored_at(slot, w.tension[at]);
      const Vec2 pull = w.tension[at] * w.inverse_length[at] * Vec2(w.ex[at], w.ey[at]);
      halve(i, pull), halve(j, -pull);
      if (parts_.hinges)
        for (const Index k : {i, j}) {
          const Index hinge = ShellLayout::slot(c, k), here = hinge - w.block.slot_begin;
          if (!parts_.hinges->present(hinge) || std::find(ended.begin(), ended.end(), k) != ended.end()) continue;
          ended.push_back(k);
          event.energy += parts_.hinges->stored_at(hinge, w.moment[here]);
          // F_(k-1) = -M n_1 / l_1, F_(k+1) = -M n_2 / l_2
          const auto side = [&](Index s) {
            return Vec2(w.moment[here] * w.inverse_length[s] * w.inverse_length[s] * left_of(Vec2(w.ex[s], w.ey[s])));
          };
          const Vec2 before = side(here - 1), behind = side(here);
          halve(sample.prev(c, k), -before), halve(k, before + behind), halve(sample.next(c, k), -behind);
        }
      if (parts_.core && first && parts_.core->present(c)) {
        const Core::Released released = parts_.core->released(c, w);
        event.energy += released.energy;
        event.pressure_work = released.work;
        parts_.core->for_each_force(c, w, halve);
      }
      first = false;
      breaks.push_back(event);
    }
  }
}

WallRupture::Loaded WallRupture::most_loaded(const Field& x, ShellScratch& w) const {
  const Sample& sample = layout_.sample();
  Loaded most;
  if (!breakable()) return most;
  Field unused(x.size());
  for (const CellBlock& block : layout_.blocks()) {
    w.load(sample, block, x);
    parts_.bars->add_to_block(w, unused);
    for (Index c = block.cell_begin; c < block.cell_end; ++c)
      for (Index i = sample.cell_begin[c]; i < sample.cell_begin[c + 1]; ++i) {
        if (!sample.starts_segment(c, i) || broken_.gone(i)) continue;
        const Index slot = ShellLayout::slot(c, i), at = slot - block.slot_begin;
        double zeta = -1;
        if (!force_.empty()) zeta = std::max(zeta, w.tension[at] / force_[slot] - 1);
        // An elongation at which it breaks: from the rest length, so that a bar without load is as far from it as a link is.
        if (!length_.empty() && length_[slot] < kNever) {
          const double rest = sample.rest_length[i];
          zeta = std::max(zeta, (w.length[at] - rest) / (length_[slot] - rest) - 1);
        }
        if (zeta > most.zeta) most = {zeta, c, i};
      }
  }
  return most;
}

WallBreak WallRupture::broken_at(const Loaded& loaded, const Field& x, ShellScratch& w) const {
  const CellBlock& block = layout_.blocks()[layout_.block_of_cell(loaded.cell)];
  Field unused(x.size());
  w.load(layout_.sample(), block, x);
  parts_.bars->add_to_block(w, unused);
  const Index at = ShellLayout::slot(loaded.cell, loaded.bar) - block.slot_begin;
  WallBreak event;
  event.bar = loaded.bar, event.cell = loaded.cell;
  event.tension = w.tension[at];
  event.position = 0.5 * (Vec2(w.px[at], w.py[at]) + Vec2(w.px[at + 1], w.py[at + 1]));
  if (parts_.core && parts_.core->present(loaded.cell))
    event.pressure_work = parts_.core->released(loaded.cell, w).work;
  return event;
}

void WallRupture::end(Index cell, Index bar, double time) {
  const Sample& sample = layout_.sample();
  if (broken_.gone(bar)) return;
  broken_.add(cell, bar);
  break_time_[bar] = time;
  if (!force_.empty()) layout_.set_padded(force_, cell, bar, kNever);
  if (!length_.empty()) layout_.set_padded(length_, cell, bar, kNever);
  parts_.bars->end(cell, bar);
  if (parts_.dashpots) parts_.dashpots->end(cell, bar);
  if (parts_.hinges) parts_.hinges->end(cell, bar), parts_.hinges->end(cell, sample.next(cell, bar));
  if (parts_.core) parts_.core->end(cell);
}

void WallRupture::save(ArraySet& restart) const { add_output(restart); }

void WallRupture::restore(const ArraySet& restart) {
  if (!restart.find("bar_broken")) return;
  const auto& broken = restart.ints("bar_broken");
  const auto& time = restart.doubles("bar_break_time");
  const Sample& sample = layout_.sample();
  for (Index c = 0; c < sample.cells(); ++c)
    for (Index i = sample.cell_begin[c]; i < sample.cell_begin[c + 1]; ++i)
      if (broken.at(i)) end(c, i, time.at(i));
}

void WallRupture::add_output(ArraySet& frame) const {
  const auto& flags = broken_.flags();
  frame.add({"bar_broken", "1", "segment", 1, std::vector<std::int32_t>(flags.begin(), flags.end())});
  frame.add({"bar_break_time", "s", "segment", 1, break_time_});
}

std::size_t WallRupture::bytes() const {
  return sizeof(double) * (force_.size() + length_.size() + break_time_.size()) + broken_.flags().size() +
         sizeof(Index) * layout_.sample().cells();
}

}  // namespace lamella
