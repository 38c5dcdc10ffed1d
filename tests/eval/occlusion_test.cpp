// SPDX-License-Identifier: Apache-2.0
#include "eval/occlusion.h"

#include <gtest/gtest.h>
#include <limits>

namespace limber::eval {
namespace {

constexpr Vec3f kUp{0, 0, 1};

// A roof of side 2 at height 1.
const std::vector<Vec3f> kRoofPositions = {{-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}};
const std::vector<Triangle> kRoof = {{0, 1, 2}, {0, 2, 3}};

std::vector<DirectionalLight> even_sky() {
  std::vector<DirectionalLight> lights;
  for (const Vec3f& d : sphere_directions(400)) lights.push_back({d, 1.0f, 0.0f});
  return lights;
}

TEST(ReachedLight, IsHeldBackByARoofAsFarAsItFillsTheSky) {
  const std::vector<Receiver> receivers = {{{0, 0, 0}, kUp, kUp}, {{50, 0, 0}, kUp, kUp}, {{0, 0, 2}, kUp, kUp}};
  const std::vector<Reached> reached = reached_light(kRoof, kRoofPositions, even_sky(), receivers);
  // Form factor of a square of side 2 seen from 1 below its middle: four quarters, each 2 / (2 pi sqrt 2) atan(1 / sqrt
  // 2).
  EXPECT_NEAR(1.0 - reached[0].sky, 4.0 * 0.138531, 0.03);
  EXPECT_GT(reached[1].sky, 0.99f);
  EXPECT_EQ(reached[2].sky, 1.0f);
}

TEST(ReachedLight, OfTheKeyIsWhatASingleRayWouldSay) {
  const std::vector<DirectionalLight> key = {{kUp, 0.0f, 1.0f}};
  const std::vector<Receiver> receivers = {
      {{0.5f, 0.5f, 0}, kUp, kUp}, {{1.5f, 0, 0}, kUp, kUp}, {{0.5f, 0, 1}, kUp, kUp}};
  const std::vector<Reached> reached = reached_light(kRoof, kRoofPositions, key, receivers);
  EXPECT_EQ(reached[0].key, 0.0f);
  EXPECT_EQ(reached[1].key, 1.0f);
  EXPECT_EQ(reached[2].key, 1.0f) << "a surface must not shadow itself";
}

TEST(ReachedLight, IsFullBesidePositionsThatAreNotFinite) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<Vec3f> positions = {{nan, 0, 1}, {1, nan, 1}, {0, 1, nan}};
  const std::vector<Receiver> receivers = {{{0, 0, 0}, kUp, kUp}};
  const std::vector<Triangle> triangles = {{0, 1, 2}};
  EXPECT_EQ(reached_light(triangles, positions, even_sky(), receivers)[0].sky, 1.0f);
}

TEST(SphereDirections, AreUnitAndBalanced) {
  const std::vector<Vec3f> directions = sphere_directions(200);
  Vec3f sum{};
  for (const Vec3f& d : directions) {
    EXPECT_NEAR(length(d), 1.0f, 1e-5f);
    sum += d;
  }
  EXPECT_LT(length(sum), 1.0f);
}

}  // namespace
}  // namespace limber::eval
