#include "postproc/quantities/cell_energy.h"

#include <numeric>

namespace lamella {

CellEnergy cell_energy(const FrameView& view) {
  const Sample& sample = view.sample;
  CellEnergy energy;
  energy.total.assign(sample.cells(), 0.0);
  const auto take = [&](const char* name, std::vector<double>& kind) {
    const std::vector<double>* values = view.doubles(name);
    if (!values) return;
    kind = *values;
    for (std::size_t c = 0; c < kind.size(); ++c) energy.total[c] += kind[c];
  };
  take("bar_energy", energy.stretch);
  take("hinge_energy", energy.bend);
  take("core_energy", energy.core);
  if (const std::vector<double>* link_energy = view.doubles("link_energy")) {
    energy.link_share.assign(sample.cells(), 0.0);
    for (std::size_t l = 0; l < sample.links.size(); ++l) {
      const Wall& wall = sample.walls[sample.links[l].wall];
      energy.link_share[wall.cell_a] += 0.5 * (*link_energy)[l];
      energy.link_share[wall.cell_b] += 0.5 * (*link_energy)[l];
    }
  }
  return energy;
}

double link_reference_energy(const FrameView& view) {
  const std::vector<double>* w0 = view.doubles("link_w0");
  if (!w0 || w0->empty()) return 0;
  return std::accumulate(w0->begin(), w0->end(), 0.0) / static_cast<double>(w0->size());
}

}  // namespace lamella
