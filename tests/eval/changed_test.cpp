// SPDX-License-Identifier: Apache-2.0
#include "eval/changed.h"

#include <gtest/gtest.h>

namespace limber::eval {
namespace {

using Ids = std::vector<Triangle>;

TEST(ChangedTriangles, SaysNothingAboutTheFirstFrame) {
  ChangedTriangles changed;
  EXPECT_EQ(changed.add(Ids{{1, 2, 3}}), std::nullopt);
}

TEST(ChangedTriangles, FindsNothingWhereOnlyTheOrderDiffers) {
  ChangedTriangles changed;
  changed.add(Ids{{1, 2, 3}, {7, 8, 9}});
  EXPECT_EQ(changed.add(Ids{{8, 7, 9}, {2, 3, 1}}), 0.0);
}

TEST(ChangedTriangles, GivesTheShareOfTheNewOnes) {
  ChangedTriangles changed;
  changed.add(Ids{{0, 1, 2}, {1, 2, 3}, {2, 3, 4}, {3, 4, 5}});
  EXPECT_EQ(changed.add(Ids{{0, 1, 2}, {1, 2, 3}, {2, 3, 5}, {3, 4, 5}}), 0.25);
  EXPECT_EQ(changed.add(Ids{{0, 1, 2}, {1, 2, 3}}), 0.0) << "fewer triangles, none of them new";
  EXPECT_EQ(changed.add(Ids{{10, 11, 12}}), 1.0);
}

TEST(ChangedTriangles, ComparesWithTheFrameBeforeOnly) {
  ChangedTriangles changed;
  changed.add(Ids{{0, 1, 2}});
  changed.add(Ids{{3, 4, 5}});
  EXPECT_EQ(changed.add(Ids{{0, 1, 2}}), 1.0);
}

TEST(ChangedTriangles, AcceptsFramesWithoutTriangles) {
  ChangedTriangles changed;
  changed.add(Ids{{0, 1, 2}});
  EXPECT_EQ(changed.add({}), 0.0);
  EXPECT_EQ(changed.add(Ids{{0, 1, 2}}), 1.0);
}

}  // namespace
}  // namespace limber::eval
