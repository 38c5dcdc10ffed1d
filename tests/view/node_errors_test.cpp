// SPDX-License-Identifier: Apache-2.0
#include "limber/view/node_errors.h"

#include <gtest/gtest.h>

#include "tests/view/patches.h"

namespace limber {
namespace {

TEST(NodeErrors, AreRootMeanSquaresTimesAPeakAndTheLargestWeightBelow) {
  const test::Surface surface = test::sheet(3, 2);  // 4 triangles
  FrameState state;
  state.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0}, {1, 0.5f, 0}};
  state.hierarchy = {{0, 6, 7}, {6, 6, 6, 6, 6, 6, kNone}};
  state.errors = {0, 0, 0, 0, 0, 0, 3};
  NodeErrors errors(state.hierarchy);
  const std::vector<float> weights = {1, 1, 5, 1, 1, 1};
  errors.estimate(surface.mesh, state, weights);
  EXPECT_EQ(errors.weights()[0], 5);
  const float peak = NodeErrors::kPeak;
  EXPECT_NEAR(errors.squares()[0], 3 * 3 * 5 * 5 * peak * peak / 2, 1e-2) << "an area of 2";
}

TEST(NodeErrors, LearnHowHighAPeakIsAndForgetItSlowly) {
  const test::Surface surface = test::sheet(12, 13);
  const FrameState state = test::patch_state(surface, {156, 30, 8});
  NodeErrors errors(state.hierarchy);
  const std::vector<float> weights(156, 1.0f);
  errors.estimate(surface.mesh, state, weights);
  const float before = errors.squares()[3];
  errors.learn(3, 1.5f * before);
  EXPECT_NEAR(errors.squares()[3], 1.5f * before, 1e-3f * before);
  errors.estimate(surface.mesh, state, weights);
  EXPECT_GT(errors.squares()[3], 1.4f * before);
  for (int frame = 0; frame < 500; ++frame) errors.estimate(surface.mesh, state, weights);
  EXPECT_LT(errors.squares()[3], 1.1f * before);
  errors.learn(3, 0.1f * before);
  errors.estimate(surface.mesh, state, weights);
  EXPECT_GT(errors.squares()[3], 0.9f * before) << "less than estimated says nothing";
}

}  // namespace
}  // namespace limber
