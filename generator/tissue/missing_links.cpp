#include "generator/tissue/missing_links.h"

#include <fmt/format.h>

#include <cmath>
#include <numeric>
#include <vector>

#include "generator/packing/random.h"
#include "generator/sample/errors.h"

namespace lamella {
namespace {

constexpr std::uint64_t kStream = 0x6c696e6b73206f66;  // apart from the packing's numbers, which the seed itself starts

/// Keeps the entries whose flag is set. Arrays that a sample does not have are empty, and stay so.
template <class T>
void keep(const std::vector<char>& flags, std::vector<T>& values) {
  if (values.empty()) return;
  std::size_t kept = 0;
  for (std::size_t k = 0; k < values.size(); ++k)
    if (flags[k]) values[kept++] = values[k];
  values.resize(kept);
}

}  // namespace

void drop_links(double missing, std::uint64_t seed, Sample& sample, Notes& notes) {
  const std::size_t all = sample.links.size();
  if (all == 0) throw SceneError("sample.walls.missing: the sample has no link that could be absent; leave it out");
  const auto count = static_cast<std::size_t>(std::lround(missing * static_cast<double>(all)));
  std::vector<std::size_t> order(all);
  std::iota(order.begin(), order.end(), 0);
  std::vector<char> present(all, 1);
  Random random(seed ^ kStream);
  for (std::size_t k = 0; k < count; ++k) {  // Fisher and Yates, as far as is needed
    std::swap(order[k], order[k + random.below(all - k)]);
    present[order[k]] = 0;
  }
  keep(present, sample.links), keep(present, sample.link_image), keep(present, sample.link_strength);
  notes.push_back(fmt::format("{} of {} links are absent from the start", count, all));
}

}  // namespace lamella
