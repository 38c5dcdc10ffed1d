// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "limber/hierarchy/build.h"

namespace limber {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::vector<Index> targets(Index vertex_count, double branching, std::vector<Index> sizes = {}) {
  BuildOptions options;
  options.branching = branching;
  options.level_sizes = std::move(sizes);
  return level_targets(vertex_count, options);
}

TEST(LevelTargets, FallByTheBranchingFactorToTheSmallestLevel) {
  EXPECT_THAT(targets(8192, 8), ElementsAre(1024, 128, 16));
  EXPECT_THAT(targets(90, 8), IsEmpty());
}

TEST(LevelTargets, GoOnByTheBranchingFactorBeyondTheSizesAskedFor) {
  EXPECT_THAT(targets(8000, 8, {3200, 800}), ElementsAre(3200, 800, 100, 13));
}

TEST(LevelTargets, FillWideGapsEvenly) {
  EXPECT_THAT(targets(64000, 8, {1000}), ElementsAre(8000, 1000, 125, 16));
  EXPECT_THAT(targets(40000, 8, {100}), ElementsAre(5429, 737, 100, 13));
}

TEST(LevelTargets, LeaveGapsThatAreNotWideAlone) { EXPECT_THAT(targets(2200, 8, {100}), ElementsAre(100, 13)); }

TEST(LevelTargets, LeaveOutSizesThatAreNotSmallerThanTheMesh) {
  EXPECT_THAT(targets(1000, 8, {5000, 1000, 500}), ElementsAre(500, 63));
}

TEST(LevelTargets, MayGoBelowTheSmallestLevelWhereAsked) {
  EXPECT_THAT(targets(1000, 8, {200, 5}), ElementsAre(200, 32, 5));
}

TEST(LevelTargets, AlwaysDecrease) {
  for (const double branching : {1.05, 1.5, 2.0, 8.0}) {
    Index last = 1000;
    for (const Index size : targets(1000, branching, {400, 3})) {
      EXPECT_LT(size, last);
      last = size;
    }
  }
}

}  // namespace
}  // namespace limber
