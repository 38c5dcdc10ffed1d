// SPDX-License-Identifier: Apache-2.0
#include "limber/contract/edges.h"

#include <gtest/gtest.h>
#include <map>

#include "tests/support/shapes.h"

namespace limber {
namespace {

TEST(Edges, OfNothingAreNone) {
  EXPECT_TRUE(find_edges({}).ends.empty());
  EXPECT_TRUE(find_edges({5, {}}).ends.empty());
}

TEST(Edges, OfASquareAreFiveWithTheDiagonalInside) {
  const Edges edges = find_edges({4, {{0, 1, 3}, {0, 3, 2}}});
  ASSERT_EQ(edges.ends.size(), 5u);
  for (std::size_t e = 0; e < 5; ++e) {
    const bool diagonal = edges.ends[e] == std::array<Index, 2>{0, 3};
    EXPECT_EQ(edges.triangle_count[e], diagonal ? 2u : 1u);
    EXPECT_LT(edges.ends[e][0], edges.ends[e][1]);
  }
}

TEST(Edges, AreSortedBySmallerEndThenByTheFirstTriangle) {
  const Edges edges = find_edges({4, {{0, 3, 2}, {3, 0, 1}}});
  const std::vector<std::array<Index, 2>> expected = {{0, 3}, {0, 2}, {0, 1}, {1, 3}, {2, 3}};
  EXPECT_EQ(edges.ends, expected);
  EXPECT_EQ(edges.some_triangle, (std::vector<Index>{0, 0, 1, 1, 0}));
}

TEST(Edges, LeaveOutTrianglesWithARepeatedCorner) {
  const Edges edges = find_edges({4, {{0, 0, 1}, {1, 2, 1}, {3, 3, 3}, {0, 1, 2}}});
  EXPECT_EQ(edges.ends.size(), 3u);
  for (const Index count : edges.triangle_count) EXPECT_EQ(count, 1u);
  for (const Index triangle : edges.some_triangle) EXPECT_EQ(triangle, 3u);
}

TEST(Edges, CountEveryTriangleOfANonManifoldEdgeAndRepeatedTrianglesToo) {
  const Edges fins = find_edges({5, {{0, 1, 2}, {0, 1, 3}, {1, 0, 4}}});
  ASSERT_EQ(fins.ends.front(), (std::array<Index, 2>{0, 1}));
  EXPECT_EQ(fins.triangle_count.front(), 3u);
  const Edges twice = find_edges({3, {{0, 1, 2}, {2, 1, 0}}});
  EXPECT_EQ(twice.ends.size(), 3u);
  for (const Index count : twice.triangle_count) EXPECT_EQ(count, 2u);
}

TEST(Edges, AreThoseThatAMapOfEndsFinds) {
  test::Random random(1);
  for (int round = 0; round < 200; ++round) {
    Mesh mesh{2 + random.below(12), {}};
    for (Index t = random.below(30); t > 0; --t)
      mesh.triangles.push_back(
          {random.below(mesh.vertex_count), random.below(mesh.vertex_count), random.below(mesh.vertex_count)});
    std::map<std::array<Index, 2>, std::pair<Index, Index>> expected;  // triangles, first triangle
    for (Index t = 0; t < mesh.triangles.size(); ++t) {
      const auto& [a, b, c] = mesh.triangles[t];
      if (a == b || b == c || c == a) continue;
      for (const auto& [p, q] : {std::minmax(a, b), std::minmax(b, c), std::minmax(c, a)})
        ++expected.try_emplace({p, q}, 0, t).first->second.first;
    }
    const Edges edges = find_edges(mesh);
    ASSERT_EQ(edges.ends.size(), expected.size());
    for (std::size_t e = 0; e < edges.ends.size(); ++e) {
      const auto at = expected.find(edges.ends[e]);
      ASSERT_NE(at, expected.end());
      ASSERT_EQ(edges.triangle_count[e], at->second.first);
      ASSERT_EQ(edges.some_triangle[e], at->second.second);
    }
  }
}

}  // namespace
}  // namespace limber
