// SPDX-License-Identifier: Apache-2.0
#include "limber/view/witnesses.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "limber/view/cut.h"
#include "limber/view/drawn_witnesses.h"
#include "limber/view/triangle_distance.h"
#include "limber/view/triangle_list.h"
#include "tests/view/patches.h"

namespace limber {
namespace {

struct Scene {
  test::Surface surface = test::torus(40, 50);
  FrameState state = test::patch_state(surface, {2000, 400, 80, 20});
  Stars stars{surface.mesh};
  std::vector<float> weights = std::vector<float>(2000, 1.0f);

  std::vector<Index> labels(Index level) const {
    Cut cut(surface.mesh, state.hierarchy, {.by = CutBy::kLevel, .level = level});
    cut.update(surface.mesh, state);
    return {cut.labels().begin(), cut.labels().end()};
  }
};

float squared_distance(const Vec3f& p, const Scene& scene, std::span<const Index> labels) {
  TriangleList list;
  list_triangles(scene.surface.mesh, labels, list);
  float least = std::numeric_limits<float>::infinity();
  for (const Triangle& t : list.triangles) {
    const auto& x = scene.state.positions;
    least = std::min(least, squared_distance_to_triangle(p, x[t[0]], x[t[1]], x[t[2]]));
  }
  return least;
}

TEST(Witnesses, BoundTheDistanceOfEveryVertexAndMostlyTightly) {
  const Scene scene;
  Witnesses witnesses(scene.surface.mesh);
  for (const Index level : {1u, 2u, 3u, 1u}) {
    const std::vector<Index> labels = scene.labels(level);
    witnesses.find(scene.surface.mesh, scene.stars, {scene.state.positions, labels, scene.weights}, 0);
    std::size_t tight = 0;
    for (Index v = 0; v < 2000; v += 7) {
      const float truth = squared_distance(scene.state.positions[v], scene, labels);
      const float bound = witnesses.squared_bounds()[v];
      ASSERT_GE(bound, truth);
      tight += bound <= 1.01f * truth + 1e-12f;
    }
    EXPECT_GT(tight, 2000u / 7 * 7 / 10) << level;
  }
}

TEST(Witnesses, FailWhereTheLimitIsLessThanTheDistance) {
  const Scene scene;
  Witnesses witnesses(scene.surface.mesh);
  const std::vector<Index> labels = scene.labels(2);
  const DrawnSurface drawn{scene.state.positions, labels, scene.weights};
  witnesses.find(scene.surface.mesh, scene.stars, drawn, 100);
  EXPECT_TRUE(witnesses.failing().empty());
  witnesses.find(scene.surface.mesh, scene.stars, drawn, 0.1f);
  EXPECT_FALSE(witnesses.failing().empty());
  for (Index v = 0; v < 2000; ++v) {
    const auto failing = witnesses.failing();
    EXPECT_EQ(std::find(failing.begin(), failing.end(), v) != failing.end(), witnesses.squared_bounds()[v] > 0.01f);
  }
}

TEST(Witnesses, FollowTheLabelsThatChange) {
  const Scene scene;
  Witnesses witnesses(scene.surface.mesh);
  std::vector<Index> labels = scene.labels(2);
  const DrawnSurface drawn{scene.state.positions, labels, scene.weights};
  witnesses.find(scene.surface.mesh, scene.stars, drawn, 0.05f);
  const std::vector<Index> finest = scene.labels(0);
  std::vector<std::uint8_t> has_changed(2000, 0);
  for (Index v = 0; v < 900; ++v) labels[v] = finest[v], has_changed[v] = 1;
  witnesses.find_again(scene.surface.mesh, scene.stars, drawn, 0.05f, has_changed);
  for (Index v = 0; v < 2000; v += 3) {
    ASSERT_GE(witnesses.squared_bounds()[v], squared_distance(scene.state.positions[v], scene, labels)) << v;
  }
}

TEST(DrawnWitnesses, FindASpikeThatNoVertexOfTheSurfaceSees) {
  Scene scene;
  const std::vector<Index> labels = scene.labels(1);
  const std::vector<float> node_weights(500, 1.0f);
  DrawnWitnesses witnesses(scene.surface.mesh, scene.state.hierarchy);
  const auto failing = [&] {
    witnesses.begin();
    witnesses.find(scene.surface.mesh, scene.stars, {scene.state.positions, labels, scene.weights}, node_weights, 1);
    return std::vector(witnesses.failing().begin(), witnesses.failing().end());
  };
  EXPECT_TRUE(failing().empty());
  EXPECT_LE(witnesses.largest_square(), 1);
  scene.state.positions[2100] += Vec3f{0, 0, 30};
  const auto spike = failing();
  ASSERT_FALSE(spike.empty());
  EXPECT_TRUE(std::any_of(spike.begin(), spike.end(), [](const auto& failure) { return failure.node == 2100; }));
}

}  // namespace
}  // namespace limber
