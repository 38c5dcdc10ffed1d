// SPDX-License-Identifier: Apache-2.0
#include "limber/hierarchy/child_lists.h"

#include <gtest/gtest.h>

#include "tests/support/hierarchies.h"

namespace limber {
namespace {

std::vector<Index> children(const ChildLists& lists, Index node) {
  std::vector<Index> found;
  for (Index c = lists.first_child(node); c != kNone; c = lists.next_sibling(c)) found.push_back(c);
  return found;
}

TEST(ChildLists, ListTheChildrenOfEveryNodeInTheirOrder) {
  const Hierarchy h{{0, 6, 9, 11}, {6, 7, 6, 7, 8, 6, 9, 9, 10, kNone, kNone}};
  const ChildLists lists(h);
  EXPECT_EQ(children(lists, 6), (std::vector<Index>{0, 2, 5}));
  EXPECT_EQ(children(lists, 7), (std::vector<Index>{1, 3}));
  EXPECT_EQ(children(lists, 9), (std::vector<Index>{6, 7}));
  EXPECT_TRUE(children(lists, 0).empty());
}

TEST(ChildLists, AreWalkedThroughInTheirOrder) {
  const ChildLists lists(Hierarchy{{0, 4, 6}, {4, 5, 4, 4, kNone, kNone}});
  std::vector<Index> met;
  for (const Index child : lists.of(4)) met.push_back(child);
  EXPECT_EQ(met, (std::vector<Index>{0, 2, 3}));
  for (const Index child : lists.of(0)) ADD_FAILURE() << "a finest vertex has the child " << child;
}

TEST(ChildLists, FollowRandomMovesAsTheParentsDo) {
  Hierarchy h = test::built(test::jittered(test::sphere(3), 0.1f, 1), 4, Topology::kFree);
  ChildLists lists(h);
  test::Random random(1);
  for (int i = 0; i < 5000; ++i) {
    const Index node = random.below(h.level_begin[h.level_count() - 1]);
    const Index above = h.level_of(node) + 1;
    const Index to = h.level_begin[above] + random.below(h.level_size(above));
    if (to == h.parent[node]) continue;
    lists.move(node, h.parent[node], to);
    h.parent[node] = to;
    if (i % 100) continue;
    std::vector<std::vector<Index>> expected(h.node_count());
    for (Index n = 0; n < h.node_count(); ++n)
      if (h.parent[n] != kNone) expected[h.parent[n]].push_back(n);
    for (Index n = 0; n < h.node_count(); ++n) {
      std::vector<Index> found = children(lists, n);
      std::sort(found.begin(), found.end());
      ASSERT_EQ(found, expected[n]);
    }
  }
}

}  // namespace
}  // namespace limber
