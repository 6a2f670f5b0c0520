#include "generator/sample/selection.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "generator/sample/errors.h"

namespace lamella {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// A square of nodes 0 to 3 and a chain of nodes 4 to 8.
Sample square_and_chain() {
  Sample sample;
  sample.box = {Vec2::Zero(), Vec2(4, 4)};
  add_cell(sample, {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, true, 0.1, "cells");
  add_cell(sample, {{0, 3}, {1, 3}, {2, 3}, {3, 3}, {4, 3}}, false, 0.1, "beam");
  sample.side[2] = kTop | kRight;
  sample.side[3] = kTop;
  return sample;
}

std::string fault_of(const Selection& selection) {
  try {
    select_nodes(square_and_chain(), selection);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "no fault";
}

TEST(Selection, takes_nodes_by_each_of_its_ways) {
  const Sample sample = square_and_chain();
  Selection side;
  side.side = "top";
  EXPECT_THAT(select_nodes(sample, side), ElementsAre(2, 3));
  Selection box;
  box.box = Box{Vec2(0.5, 0.5), Vec2(1, 3)};
  EXPECT_THAT(select_nodes(sample, box), ElementsAre(2, 5));
  Selection group;
  group.group = "cells";
  EXPECT_THAT(select_nodes(sample, group), ElementsAre(0, 1, 2, 3));
  Selection cells;
  cells.cells = {1};
  EXPECT_THAT(select_nodes(sample, cells), ElementsAre(4, 5, 6, 7, 8));
  Selection nodes;
  nodes.nodes = {7, 1, 7};
  EXPECT_THAT(select_nodes(sample, nodes), ElementsAre(1, 7));
}

TEST(Selection, takes_the_ends_of_chains_only) {
  const Sample sample = square_and_chain();
  Selection end;
  end.end = "start";
  EXPECT_THAT(select_nodes(sample, end), ElementsAre(4));
  end.end = "end";
  EXPECT_THAT(select_nodes(sample, end), ElementsAre(8));
  end.end = "clamp_start";
  EXPECT_THAT(select_nodes(sample, end), ElementsAre(4, 5));
  end.end = "clamp_end";
  EXPECT_THAT(select_nodes(sample, end), ElementsAre(7, 8));
  end.end = "middle";
  end.group = "beam";
  EXPECT_THAT(select_nodes(sample, end), ElementsAre(6));
  end.group = "cells";
  EXPECT_THAT(fault_of(end), HasSubstr("no open chains"));
}

TEST(Selection, says_what_exists_when_it_names_what_does_not) {
  Selection group;
  group.group = "plate";
  EXPECT_THAT(fault_of(group), HasSubstr("cells, beam"));
  Selection cells;
  cells.cells = {2};
  EXPECT_THAT(fault_of(cells), HasSubstr("cells 0 to 1"));
  Selection nodes;
  nodes.nodes = {-1};
  EXPECT_THAT(fault_of(nodes), HasSubstr("nodes 0 to 8"));
  Selection side;
  side.side = "left";
  EXPECT_THAT(fault_of(side), HasSubstr("selects no node"));
  side.side = "upper";
  EXPECT_THAT(fault_of(side), HasSubstr("bottom"));
  Selection box;
  box.box = Box{Vec2(2, 0), Vec2(3, 1)};
  EXPECT_THAT(fault_of(box), HasSubstr("selects no node"));
  Selection end;
  end.end = "tip";
  EXPECT_THAT(fault_of(end), HasSubstr("clamp_start"));
}

}  // namespace
}  // namespace lamella
