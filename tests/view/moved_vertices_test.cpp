// SPDX-License-Identifier: Apache-2.0
#include "limber/view/moved_vertices.h"

#include <gtest/gtest.h>

#include "limber/view/extract.h"
#include "tests/view/patches.h"

namespace limber {
namespace {

// A row of three by two vertices; level 1: 6 = {0, 1}, 7 = {2, 5}, 8 = {3, 4}; level 2: 9 = {6, 7}, 10 = {8}.
FrameState six_state() {
  FrameState state;
  state.hierarchy.level_begin = {0, 6, 9, 11};
  state.hierarchy.parent = {6, 6, 7, 8, 8, 7, 9, 9, 10, kNone, kNone};
  state.positions.resize(11);
  state.errors.resize(11);
  return state;
}

// The nodes marked where `swap` is made; every active node counts as a vertex.
std::vector<Index> moved_nodes(const Swap& swap, const CutOptions& options) {
  const Mesh mesh{6, {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}}};
  FrameState state = six_state();
  const std::vector<Index> old_parents = state.hierarchy.parent;
  state.swaps = {swap};
  apply(state.hierarchy, swap);
  Cut cut(mesh, state.hierarchy, options);
  cut.update(mesh, state);
  std::vector<Index> vertex_of_node(11, kNone), nodes;
  for (Index n = 0; n < 11; ++n) {
    if (!cut.is_active(n)) continue;
    vertex_of_node[n] = static_cast<Index>(nodes.size());
    nodes.push_back(n);
  }
  std::vector<std::uint8_t> moved(nodes.size(), 7);
  mark_moved(state.swaps, old_parents, cut, vertex_of_node, moved);
  std::vector<Index> marked;
  for (std::size_t v = 0; v < nodes.size(); ++v) {
    if (moved[v] == 1) marked.push_back(nodes[v]);
  }
  return marked;
}

TEST(MovedVertices, AreTheOneThatLosesAndTheOneThatGains) {
  EXPECT_EQ(moved_nodes({1, 8}, {.level = 1}), (std::vector<Index>{6, 8}));
  EXPECT_EQ(moved_nodes({1, 8}, {.level = 2}), (std::vector<Index>{9, 10}));
}

TEST(MovedVertices, AreNoneWhereTheNodeIsDrawnItself) { EXPECT_TRUE(moved_nodes({1, 8}, {.level = 0}).empty()); }

TEST(MovedVertices, AreNoneWhereTheMoveIsWithinOne) { EXPECT_TRUE(moved_nodes({1, 7}, {.level = 2}).empty()); }

}  // namespace
}  // namespace limber
