#include "generator/sample/selection.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "generator/sample/errors.h"

namespace lamella {
namespace {

std::uint8_t side_bit(const std::string& side) {
  if (side == "left") return kLeft;
  if (side == "right") return kRight;
  if (side == "bottom") return kBottom;
  if (side == "top") return kTop;
  throw SceneError(fmt::format("unknown side \"{}\"; left, right, bottom or top", side));
}

Index find_group(const Sample& sample, const std::string& name) {
  for (std::size_t g = 0; g < sample.group_names.size(); ++g)
    if (sample.group_names[g] == name) return static_cast<Index>(g);
  throw SceneError(
      fmt::format("no cells of group \"{}\" in the sample; it has {}", name, fmt::join(sample.group_names, ", ")));
}

void add_cell_nodes(const Sample& sample, Index c, std::vector<Index>& nodes) {
  for (Index k = sample.cell_begin[c]; k < sample.cell_begin[c + 1]; ++k) nodes.push_back(k);
}

/// Node of a chain nearest to half its length.
Index middle_node(const Sample& sample, Index c) {
  double total = 0;
  for (Index k = sample.cell_begin[c]; k < sample.cell_begin[c + 1]; ++k) total += sample.rest_length[k];
  double before = 0;
  double nearest = total;
  Index middle = sample.cell_begin[c];
  for (Index k = sample.cell_begin[c]; k < sample.cell_begin[c + 1]; ++k) {
    const double off = std::abs(before - total / 2);
    if (off < nearest * (1 - 1e-9)) {
      nearest = off;
      middle = k;
    }
    before += sample.rest_length[k];
  }
  return middle;
}

void add_chain_end(const Sample& sample, Index c, const std::string& end, std::vector<Index>& nodes) {
  const Index first = sample.cell_begin[c];
  const Index last = sample.cell_begin[c + 1] - 1;
  if (end == "start") nodes.push_back(first);
  if (end == "end") nodes.push_back(last);
  if (end == "clamp_start") nodes.insert(nodes.end(), {first, first + 1});
  if (end == "clamp_end") nodes.insert(nodes.end(), {last - 1, last});
  if (end == "middle") nodes.push_back(middle_node(sample, c));
}

void add_ends(const Sample& sample, const Selection& selection, std::vector<Index>& nodes) {
  const auto known = {"start", "end", "clamp_start", "clamp_end", "middle"};
  if (std::find(known.begin(), known.end(), selection.end) == known.end())
    throw SceneError(fmt::format("unknown end \"{}\"; {}", selection.end, fmt::join(known, ", ")));
  const Index group = selection.group.empty() ? -1 : find_group(sample, selection.group);
  for (Index c = 0; c < sample.cells(); ++c)
    if (!sample.closed[c] && (group < 0 || sample.group[c] == group)) add_chain_end(sample, c, selection.end, nodes);
  if (nodes.empty())
    throw SceneError(fmt::format("end = \"{}\": {} has no open chains, and only they have ends", selection.end,
                                 group < 0 ? std::string("the sample") : "group \"" + selection.group + "\""));
}

void require_index(int index, Index count, const char* what) {
  if (index < 0 || index >= count)
    throw SceneError(fmt::format("{} {} does not exist; the sample has {}s 0 to {}", what, index, what, count - 1));
}

std::string described(const Selection& selection) {
  if (!selection.side.empty()) return "side \"" + selection.side + "\"";
  if (selection.box)
    return fmt::format("box [{:g}, {:g}, {:g}, {:g}]", selection.box->lo.x(), selection.box->lo.y(),
                       selection.box->hi.x(), selection.box->hi.y());
  if (!selection.group.empty()) return "group \"" + selection.group + "\"";
  return "the selection";
}

}  // namespace

std::vector<Index> select_nodes(const Sample& sample, const Selection& selection) {
  std::vector<Index> nodes;
  if (!selection.end.empty()) {
    add_ends(sample, selection, nodes);
  } else if (!selection.side.empty()) {
    const std::uint8_t bit = side_bit(selection.side);
    for (Index k = 0; k < sample.nodes(); ++k)
      if (sample.side[k] & bit) nodes.push_back(k);
  } else if (selection.box) {
    for (Index k = 0; k < sample.nodes(); ++k)
      if (selection.box->contains(sample.x[k])) nodes.push_back(k);
  } else if (!selection.group.empty()) {
    const Index group = find_group(sample, selection.group);
    for (Index c = 0; c < sample.cells(); ++c)
      if (sample.group[c] == group) add_cell_nodes(sample, c, nodes);
  } else if (!selection.cells.empty()) {
    for (const int c : selection.cells) {
      require_index(c, sample.cells(), "cell");
      add_cell_nodes(sample, c, nodes);
    }
  } else {
    for (const int k : selection.nodes) {
      require_index(k, sample.nodes(), "node");
      nodes.push_back(k);
    }
  }
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  if (nodes.empty()) {
    const Vec2& lo = sample.box.lo;
    const Vec2& hi = sample.box.hi;
    throw SceneError(fmt::format("{} selects no node; the sample has {} nodes in the box [{:g}, {:g}, {:g}, {:g}]",
                                 described(selection), sample.nodes(), lo.x(), lo.y(), hi.x(), hi.y()));
  }
  return nodes;
}

}  // namespace lamella
