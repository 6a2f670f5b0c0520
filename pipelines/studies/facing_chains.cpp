#include "pipelines/studies/facing_chains.h"

namespace lamella {

Sample make_facing_chains(const FacingChains& chains) {
  Sample sample;
  std::vector<Vec2> upper, lower;
  for (int k = 0; k <= chains.segments; ++k) {
    upper.emplace_back(k * chains.spacing, chains.radius);
    lower.emplace_back((chains.segments - k) * chains.spacing, -chains.radius);
  }
  add_cell(sample, upper, false, chains.radius, "upper");
  add_cell(sample, lower, false, chains.radius, "lower");
  const double length = chains.segments * chains.spacing, reach = 2 * chains.radius;
  sample.box = {{-reach, -reach}, {length + reach, reach}};
  sample.walls.push_back({0, 1, (chains.segments - chains.first_link) * chains.spacing});
  for (int k = chains.first_link; k <= chains.segments; ++k) {
    const bool first = k == chains.first_link, last = k == chains.segments;
    Link link;
    link.a = upper_node(chains, k), link.b = lower_node(chains, k);
    // One-sided at the wall's ends: only segments of the linked part enter the tangent.
    link.a_prev = upper_node(chains, first ? k : k - 1), link.a_next = upper_node(chains, last ? k : k + 1);
    link.b_prev = lower_node(chains, last ? k : k + 1), link.b_next = lower_node(chains, first ? k : k - 1);
    link.wall_end = first || last ? 1 : 0;
    link.length = first || last ? chains.spacing / 2 : chains.spacing;
    link.spacing = chains.spacing;
    link.offset_n = 2 * chains.radius;
    sample.links.push_back(link);
  }
  return sample;
}

}  // namespace lamella
