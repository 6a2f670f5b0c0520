#include "simulator/shells.h"

#include <algorithm>
#include <cmath>

namespace lamella {
namespace {

// Copies one component of a field into the padded layout of a block.
void copy_padded(const Sample& sample, const CellBlock& block, const double* from, double* to) {
  for (Index c = block.cell_begin; c < block.cell_end; ++c) {
    const Index begin = sample.cell_begin[c], n = sample.cell_begin[c + 1] - begin;
    double* const p = to + (ShellLayout::slot(c, begin) - block.slot_begin);
    std::copy_n(from + begin, n, p);
    const bool closed = sample.closed[c] != 0;
    // A chain has no segment beyond its ends; mirrored ghosts keep lengths positive there.
    p[-1] = closed ? p[n - 1] : 2 * p[0] - p[1];
    p[n] = closed ? p[0] : 2 * p[n - 1] - p[n - 2];
  }
}

}  // namespace

ShellLayout::ShellLayout(const Sample& sample, Index nodes_per_block) : sample_(&sample) {
  for (Index c = 0; c < sample.cells();) {
    CellBlock block;
    block.cell_begin = c;
    block.node_begin = sample.cell_begin[c];
    block.slot_begin = block.node_begin + 2 * c;
    do ++c;
    while (c < sample.cells() && sample.cell_begin[c + 1] - block.node_begin <= nodes_per_block);
    block.cell_end = c;
    block.node_end = sample.cell_begin[c];
    block.slots = block.node_end + 2 * c - block.slot_begin;
    largest_ = std::max(largest_, block.slots);
    block_of_cell_.resize(c, static_cast<Index>(blocks_.size()));
    blocks_.push_back(block);
  }
  constexpr Index most_chunks =
      8;  // links between chunks take a detour, so few; and more than the cores we divide them among
  const Index count = static_cast<Index>(blocks_.size()), chunks = std::min(most_chunks, count);
  for (Index k = 0; k <= chunks; ++k)
    chunk_.push_back(static_cast<Index>(static_cast<std::int64_t>(count) * k / std::max<Index>(chunks, 1)));
  for (Index k = 0; k < chunks; ++k) chunk_of_block_.resize(chunk_[k + 1], k);
}

std::vector<double> ShellLayout::padded(const std::vector<double>& per_node, double filler) const {
  std::vector<double> out(slots(), filler);
  for (Index c = 0; c < sample_->cells(); ++c) {
    const Index begin = sample_->cell_begin[c], n = sample_->cell_size(c), at = slot(c, begin);
    std::copy_n(per_node.begin() + begin, n, out.begin() + at);
    if (sample_->closed[c]) out[at - 1] = per_node[begin + n - 1], out[at + n] = per_node[begin];
  }
  return out;
}

void ShellLayout::set_padded(std::vector<double>& per_slot, Index cell, Index node, double value) const {
  const Index begin = sample_->cell_begin[cell], end = sample_->cell_begin[cell + 1];
  per_slot[slot(cell, node)] = value;
  if (!sample_->closed[cell]) return;
  if (node + 1 == end) per_slot[slot(cell, begin) - 1] = value;
  if (node == begin) per_slot[slot(cell, end - 1) + 1] = value;
}

std::vector<double> ShellLayout::unpadded(const std::vector<double>& per_slot) const {
  std::vector<double> out(sample_->nodes());
  for (Index c = 0; c < sample_->cells(); ++c)
    std::copy_n(per_slot.begin() + slot(c, sample_->cell_begin[c]), sample_->cell_size(c),
                out.begin() + sample_->cell_begin[c]);
  return out;
}

ShellScratch::ShellScratch(const ShellLayout& layout) {
  const std::size_t n = layout.largest_block() + 8;
  for (auto* v : {&px, &py, &ex, &ey, &length, &inverse_length, &sx, &sy, &angle, &moment, &tension, &vx, &vy})
    v->assign(n, 0.0);
}

void ShellScratch::load(const Sample& sample, const CellBlock& at, const Field& x) {
  block = at;
  copy_padded(sample, block, x.x.data(), px.data());
  copy_padded(sample, block, x.y.data(), py.data());
  const Index n = block.slots - 1;
  const double *X = px.data(), *Y = py.data();
  double *EX = ex.data(), *EY = ey.data(), *L = length.data(), *IL = inverse_length.data(), *SX = sx.data(),
         *SY = sy.data();
#pragma omp simd
  for (Index s = 0; s < n; ++s) {
    const double dx = X[s + 1] - X[s], dy = Y[s + 1] - Y[s];
    const double l = std::sqrt(dx * dx + dy * dy + 1e-300);
    EX[s] = dx, EY[s] = dy, L[s] = l, IL[s] = 1.0 / l, SX[s] = 0, SY[s] = 0;
  }
  EX[n] = 1, EY[n] = 0, L[n] = 1, IL[n] = 1, SX[n] = 0, SY[n] = 0;
}

void ShellScratch::add_section_forces(const Sample& sample, Field& f) const {
  for (Index c = block.cell_begin; c < block.cell_end; ++c) {
    const Index begin = sample.cell_begin[c], n = sample.cell_begin[c + 1] - begin;
    const Index at = ShellLayout::slot(c, begin) - block.slot_begin;
    const double *SX = sx.data() + at, *SY = sy.data() + at;
    double *FX = f.x.data() + begin, *FY = f.y.data() + begin;
#pragma omp simd
    for (Index k = 0; k < n; ++k) {
      FX[k] += SX[k] - SX[k - 1];
      FY[k] += SY[k] - SY[k - 1];
    }
  }
}

void ShellScratch::load_velocity(const Sample& sample, const Field& v) {
  copy_padded(sample, block, v.x.data(), vx.data());
  copy_padded(sample, block, v.y.data(), vy.data());
}

}  // namespace lamella
