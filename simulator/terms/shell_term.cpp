#include "simulator/terms/shell_term.h"

#include <numeric>

namespace lamella {

double ShellTerm::dissipated() const { return std::accumulate(dissipated_.begin(), dissipated_.end(), 0.0); }

void ShellTerm::add_force(const Field& x, Field& f) const {
  ShellScratch scratch(layout_);
  for (const auto& block : layout_.blocks()) {
    scratch.load(layout_.sample(), block, x);
    add_to_block(scratch, f);
    scratch.add_section_forces(layout_.sample(), f);
  }
}

void ShellTerm::commit(const Field& x) {
  if (!has_history()) return;
  ShellScratch scratch(layout_);
  Field unused(x.size());
  for (std::size_t b = 0; b < layout_.blocks().size(); ++b) {
    scratch.load(layout_.sample(), layout_.blocks()[b], x);
    add_to_block(scratch, unused);
    commit_block(static_cast<Index>(b), scratch);
  }
}

}  // namespace lamella
