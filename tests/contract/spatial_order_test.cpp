// SPDX-License-Identifier: Apache-2.0
#include "limber/contract/spatial_order.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <numeric>

#include "tests/support/shapes.h"

namespace limber {
namespace {

using test::Shape;

std::vector<Index> spatial_order(const std::vector<Vec3f>& positions) {
  return in_spatial_order(Mesh{static_cast<Index>(positions.size()), {}}, positions).order;
}

TEST(SpatialOrder, NamesEveryVertexOnce) {
  for (const Shape& shape : {test::jittered(test::sphere(3), 0.2f, 1), test::sheet(40, 30), Shape{}}) {
    std::vector<Index> order = spatial_order(shape.positions);
    std::sort(order.begin(), order.end());
    std::vector<Index> all(shape.positions.size());
    std::iota(all.begin(), all.end(), 0u);
    EXPECT_EQ(order, all);
  }
}

TEST(SpatialOrder, KeepsTheOrderOfVerticesInOnePlace) {
  const std::vector<Vec3f> same(100, Vec3f{1, 2, 3});
  const std::vector<Index> order = spatial_order(same);
  EXPECT_TRUE(std::is_sorted(order.begin(), order.end()));
}

TEST(SpatialOrder, RunsThroughAnEighthOfTheBoxAtATime) {
  std::vector<Vec3f> positions;
  test::Random random(2);
  for (int i = 0; i < 1000; ++i) positions.push_back(random.point());
  positions.push_back({-1, -1, -1});
  positions.push_back({1, 1, 1});
  int changes = 0, last = -1;
  for (const Index v : spatial_order(positions)) {
    const Vec3f& p = positions[v];
    const int eighth = (p.x > 0) + 2 * (p.y > 0) + 4 * (p.z > 0);
    if (std::min({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) < 0.01f) continue;  // in the cells on the middle
    changes += eighth != last;
    last = eighth;
  }
  EXPECT_EQ(changes, 8);
}

TEST(SpatialOrder, IsTheSameAtEveryPlaceAndScaleThatIsExact) {
  const Shape shape = test::quantized(test::jittered(test::sphere(3), 0.2f, 3), 1024);
  const std::vector<Index> expected = spatial_order(shape.positions);
  EXPECT_EQ(spatial_order(moved(shape, [](Vec3f p) { return p * 0x1p20f; }).positions), expected);
  EXPECT_EQ(spatial_order(moved(shape, [](Vec3f p) { return p * 0x1p-100f; }).positions), expected);
  EXPECT_EQ(spatial_order(moved(shape, [](Vec3f p) { return p + Vec3f{-512, 64, 4096}; }).positions), expected);
}

TEST(SpatialOrder, TakesExtentsOfAnySize) {
  for (const float size : {1e-45f, 1e-38f, 1e38f}) {
    const std::vector<Vec3f> positions = {{size, 0, 0}, {0, 0, 0}, {-size, 0, 0}};
    EXPECT_EQ(spatial_order(positions), (std::vector<Index>{2, 1, 0})) << size;
  }
}

TEST(SpatialOrder, GivesTheSameMeshUnderOtherNames) {
  const Shape shape = test::jittered(test::torus(5, 8), 0.1f, 4);
  const auto [order, places, other] = in_spatial_order(shape.mesh, shape.positions);
  ASSERT_EQ(other.vertex_count, shape.mesh.vertex_count);
  ASSERT_EQ(places.size(), order.size());
  for (Index i = 0; i < order.size(); ++i) EXPECT_EQ(places[order[i]], i);
  std::vector<Triangle> back = other.triangles, expected = shape.mesh.triangles;
  EXPECT_TRUE(std::is_sorted(back.begin(), back.end(), [](const auto& s, const auto& t) { return s[0] < t[0]; }));
  for (Triangle& t : back)
    for (Index& corner : t) corner = order[corner];
  std::sort(back.begin(), back.end());
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(back, expected);
}

}  // namespace
}  // namespace limber
