// SPDX-License-Identifier: Apache-2.0
#include "limber/view/stars.h"

#include <algorithm>
#include <gtest/gtest.h>

#include "tests/view/patches.h"

namespace limber {
namespace {

std::vector<Index> star(const Stars& stars, Index vertex) {
  const auto faces = stars.of(vertex);
  return {faces.begin(), faces.end()};
}

TEST(Stars, HoldTheTrianglesAroundAVertexInRisingOrder) {
  const Stars stars(Mesh{6, {{0, 1, 2}, {1, 3, 2}, {2, 3, 4}, {3, 5, 4}}});
  EXPECT_EQ(star(stars, 0), (std::vector<Index>{0}));
  EXPECT_EQ(star(stars, 2), (std::vector<Index>{0, 1, 2}));
  EXPECT_EQ(star(stars, 5), (std::vector<Index>{3}));
}

TEST(Stars, AreEmptyWhereNoTriangleIs) {
  const Stars stars(Mesh{5, {{1, 2, 3}}});
  EXPECT_TRUE(stars.of(0).empty());
  EXPECT_TRUE(stars.of(4).empty());
  EXPECT_TRUE(Stars(Mesh{1, {}}).of(0).empty());
}

TEST(Stars, LeaveOutTrianglesThatHaveACornerTwice) {
  const Stars stars(Mesh{3, {{0, 0, 1}, {0, 1, 2}, {2, 2, 2}}});
  EXPECT_EQ(star(stars, 0), (std::vector<Index>{1}));
  EXPECT_EQ(star(stars, 2), (std::vector<Index>{1}));
}

TEST(Stars, NameEveryTriangleOnceAtEachOfItsCornersAndNowhereElse) {
  const Mesh mesh = test::torus(9, 13).mesh;
  const Stars stars(mesh);
  std::size_t sum = 0;
  for (Index v = 0; v < mesh.vertex_count; ++v) {
    const auto faces = stars.of(v);
    sum += faces.size();
    EXPECT_TRUE(std::is_sorted(faces.begin(), faces.end()));
    for (const Index face : faces)
      EXPECT_EQ(std::count(mesh.triangles[face].begin(), mesh.triangles[face].end(), v), 1);
  }
  EXPECT_EQ(sum, 3 * mesh.triangles.size());
}

}  // namespace
}  // namespace limber
