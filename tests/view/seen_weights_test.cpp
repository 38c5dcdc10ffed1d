// SPDX-License-Identifier: Apache-2.0
#include "limber/view/seen_weights.h"

#include <gtest/gtest.h>

namespace limber {
namespace {

constexpr Index kCount = 6;

// A triangle that faces the eye of the view below, one that faces away, both 4 from it; and all of them scaled.
struct Sight {
  Mesh mesh{kCount, {{0, 1, 2}, {3, 5, 4}}};
  std::vector<Vec3f> positions = {{0, 0, 1}, {0.1f, 0, 1}, {0, 0.1f, 1}, {0, 0, 1}, {0.1f, 0, 1}, {0, 0.1f, 1}};
  View view{.camera = Camera{.eye = {0, 0, 5}, .fov_degrees = 90}, .width = 200, .height = 100};
};

std::vector<float> weigh(const Sight& sight, float limit = 1) {
  SeenWeights weights;
  weights.measure(sight.mesh, sight.positions, sight.view, limit);
  return {weights.weights().begin(), weights.weights().end()};
}

TEST(SeenWeights, AreThePixelsOfALengthAtTheDepth) {
  Sight sight;
  EXPECT_NEAR(weigh(sight)[0], 50.0 / 4, 1e-4) << "at depth 1 a picture of 100 pixels and 90 degrees is 2 high";
  sight.positions[0] = {3, 2, -3};
  EXPECT_NEAR(weigh(sight)[0], 50.0 / 8, 1e-4) << "depth, not distance";
}

TEST(SeenWeights, AllowHalfOfTheDistanceToThePictureOutsideIt) {
  Sight sight;
  sight.positions[0] = {0, 20, 1};  // 16 above the upper plane at this depth, 16 / sqrt(2) from it
  EXPECT_NEAR(1 / weigh(sight, 2)[0], 4 / 50.0 + 16 / std::sqrt(2.0) / 2 / 2, 1e-4);
  sight.positions[0] = {0, 0, 30};
  EXPECT_GT(weigh(sight)[0], 0) << "behind the eye";
  EXPECT_LT(weigh(sight)[0], 0.1f);
}

TEST(SeenWeights, AreLessWhereTheSurfaceFacesAwayAndMoreOnSilhouettes) {
  Sight sight;
  const float before = weigh(sight)[0];
  sight.view.facing_away = 8;
  EXPECT_NEAR(weigh(sight)[0], before, 1e-4);
  EXPECT_NEAR(weigh(sight)[3], before / 8, 1e-4);
  sight.view.silhouettes = 3;
  sight.positions[0] = sight.positions[1] = {0, 0, 1}, sight.positions[1].z = 0.9f;  // in the plane x = 0
  EXPECT_NEAR(weigh(sight)[0], 3 * before, 0.05);
}

TEST(SeenWeights, FallOffAroundAFocusAndAlongAnAxis) {
  Sight sight;
  const float before = weigh(sight)[0];
  sight.view.focus = Focus{.center = {0, 0, 1}, .radius = 0.05, .outside = 9};
  EXPECT_NEAR(weigh(sight)[0], before, 1e-4);
  EXPECT_NEAR(weigh(sight)[1], before / 9, 1e-4) << "two radii away";
  sight.view.focus.reset();
  sight.view.along = Along{.axis = 0, .from = 0.2, .to = 0, .coarsest = 5};
  EXPECT_NEAR(weigh(sight)[0], before / 5, 1e-4);
  EXPECT_NEAR(weigh(sight)[1], before / 3, 1e-4) << "half-way";
}

TEST(SeenWeights, WithoutACameraCountPercentOfTheDiagonal) {
  Sight sight;
  sight.view.camera.reset();
  sight.positions[5] = {3, 4, 1};
  for (const float weight : weigh(sight)) EXPECT_NEAR(weight, 20, 1e-3);
}

}  // namespace
}  // namespace limber
