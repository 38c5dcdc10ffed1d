// SPDX-License-Identifier: Apache-2.0
#include "limber/hierarchy/hierarchy.h"

#include <gtest/gtest.h>

namespace limber {
namespace {

// The one drawn in the header.
const Hierarchy kDrawn{{0, 6, 9, 11}, {6, 6, 7, 7, 8, 8, 9, 9, 10, kNone, kNone}};

TEST(Hierarchy, KnowsItsLevels) {
  EXPECT_EQ(kDrawn.level_count(), 3u);
  EXPECT_EQ(kDrawn.node_count(), 11u);
  EXPECT_EQ(kDrawn.vertex_count(), 6u);
  EXPECT_EQ(kDrawn.level_size(0), 6u);
  EXPECT_EQ(kDrawn.level_size(1), 3u);
  EXPECT_EQ(kDrawn.level_size(2), 2u);
  const Index level_of[] = {0, 0, 0, 0, 0, 0, 1, 1, 1, 2, 2};
  for (Index node = 0; node < 11; ++node) EXPECT_EQ(kDrawn.level_of(node), level_of[node]);
}

TEST(Hierarchy, TakesASwapAsANewParent) {
  Hierarchy h = kDrawn;
  apply(h, {7, 10});
  EXPECT_EQ(h.parent[7], 10u);
  EXPECT_NE(h, kDrawn);
  apply(h, {7, 9});
  EXPECT_EQ(h, kDrawn);
}

}  // namespace
}  // namespace limber
