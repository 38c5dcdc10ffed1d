// SPDX-License-Identifier: Apache-2.0
#include "limber/fourface/face_table.h"

#include <algorithm>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/shapes.h"
#include "tests/support/topology.h"

namespace limber {
namespace {

using testing::ElementsAre;
using testing::UnorderedElementsAre;

// Six triangles around vertex 0, whose neighbours are 1 to 6.
Mesh hexagon() { return {7, {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 6}, {0, 6, 1}}}; }

std::vector<Index> ring(const FaceTable& faces, Index v) {
  Star star;
  if (!faces.gather(v, star)) return {};
  return {star.ring.begin(), star.ring.begin() + star.count};
}

// With the smallest corner first, sorted.
std::vector<Triangle> triangles(const FaceTable& faces) {
  std::vector<Triangle> all;
  for (Index f = 0; f < faces.face_slots(); ++f) {
    Triangle t = faces.face(f).corners;
    if (t[0] == kNone) continue;
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    all.push_back(t);
  }
  std::sort(all.begin(), all.end());
  return all;
}

TEST(FaceTable, GathersTheNeighboursOfAnInnerVertexCounterClockwise) {
  const FaceTable faces(hexagon());
  std::vector<Index> neighbours = ring(faces, 0);
  std::rotate(neighbours.begin(), std::ranges::find(neighbours, 1u), neighbours.end());
  EXPECT_THAT(neighbours, ElementsAre(1, 2, 3, 4, 5, 6));
}

TEST(FaceTable, GathersTheNeighboursOfABorderVertexFromBorderToBorder) {
  const FaceTable faces(hexagon());
  EXPECT_THAT(ring(faces, 2), ElementsAre(3, 0, 1));
}

TEST(FaceTable, DoesNotWalkAroundAVertexBetweenTwoFans) {
  const FaceTable faces({5, {{0, 1, 2}, {0, 3, 4}}});
  EXPECT_TRUE(faces.is_complex(0));
  EXPECT_THAT(ring(faces, 0), ElementsAre());
  EXPECT_FALSE(faces.is_complex(1));
}

TEST(FaceTable, TakesEdgesOfThreeTrianglesForBordersBetweenComplexVertices) {
  const FaceTable faces({5, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}});
  EXPECT_TRUE(faces.is_complex(0));
  EXPECT_TRUE(faces.is_complex(1));
  EXPECT_FALSE(faces.has_turned_edges());
  EXPECT_TRUE(faces.has_edge(0, 3));
  EXPECT_FALSE(faces.has_edge(3, 4));
}

TEST(FaceTable, NoticesTrianglesThatPassAnEdgeInTheSameDirection) {
  EXPECT_TRUE(FaceTable({4, {{0, 1, 2}, {0, 1, 3}}}).has_turned_edges());
  EXPECT_FALSE(FaceTable({4, {{0, 1, 2}, {1, 0, 3}}}).has_turned_edges());
}

TEST(FaceTable, LeavesDegenerateTrianglesOut) {
  const FaceTable faces({4, {{0, 1, 1}, {0, 1, 2}, {3, 3, 3}}});
  EXPECT_EQ(faces.face_count(), 1u);
  EXPECT_EQ(faces.outgoing(3), kNone);
}

TEST(FaceTable, KnowsWhichVerticesAreJoined) {
  const test::Shape torus = test::torus(7, 9);
  const FaceTable faces(torus.mesh);
  std::set<std::pair<Index, Index>> edges;
  for (const auto& [a, b, c] : torus.mesh.triangles)
    edges.insert({std::minmax(a, b), std::minmax(b, c), std::minmax(c, a)});
  for (Index a = 0; a < torus.mesh.vertex_count; ++a)
    for (Index b = 0; b < a; ++b) ASSERT_EQ(faces.has_edge(a, b), edges.contains({b, a})) << a << " " << b;
}

TEST(FaceTable, IsClosedWhereEveryEdgeHasTwoTriangles) {
  EXPECT_TRUE(FaceTable(test::torus(7, 9).mesh).is_closed());
  EXPECT_FALSE(FaceTable(test::sheet(3, 3).mesh).is_closed());
  EXPECT_FALSE(FaceTable({5, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}}).is_closed());
}

// The neighbours 2 and 6 of a hexagon's centre are swapped away; what is left of its star is the quad 1, 3, 4, 5, and
// removing the centre with the edge (1, 4) leaves what contracting the edge (0, 1) does.
TEST(FaceTable, MakesAnEdgeCollapseOfTwoSwapsAndTheRemovalOfAVertexOfFourFaces) {
  FaceTable faces(hexagon());
  Star star;
  ASSERT_TRUE(faces.gather(0, star));
  faces.swap(star, star.place_of(2));
  faces.swap(star, star.place_of(6));
  ASSERT_EQ(star.count, 4u);
  Star again;
  ASSERT_TRUE(faces.gather(0, again));
  EXPECT_THAT(std::vector(again.ring.begin(), again.ring.begin() + again.count), UnorderedElementsAre(1, 3, 4, 5));
  for (std::uint32_t i = 0; i < star.count; ++i) {
    EXPECT_EQ(faces.origin(star.spoke[i]), 0u);
    EXPECT_EQ(faces.target(star.spoke[i]), star.ring[i]);
  }
  faces.remove_between_four(star, star.place_of(1), false);
  EXPECT_THAT(triangles(faces),
              ElementsAre(Triangle{1, 2, 3}, Triangle{1, 3, 4}, Triangle{1, 4, 5}, Triangle{1, 5, 6}));
  EXPECT_EQ(faces.face_count(), 4u);
  EXPECT_EQ(faces.outgoing(0), kNone);
}

TEST(FaceTable, RemovesAVertexOfThreeFaces) {
  FaceTable faces({4, {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}}});
  Star star;
  ASSERT_TRUE(faces.gather(0, star));
  faces.remove_between_three(star);
  EXPECT_THAT(triangles(faces), ElementsAre(Triangle{1, 2, 3}));
}

TEST(FaceTable, RemovesABorderVertexAndTheNewEdgeIsABorder) {
  FaceTable faces({4, {{0, 1, 2}, {0, 2, 3}}});
  Star star;
  ASSERT_TRUE(faces.gather(0, star));
  const Index left = faces.remove_between_three(star);
  EXPECT_THAT(triangles(faces), ElementsAre(Triangle{1, 2, 3}));
  EXPECT_EQ(faces.face(left).lines, 7);
}

// Random swaps, of edges that may be swapped: the table stays what building it from its triangles gives.
TEST(FaceTable, StaysConsistentUnderRandomSwaps) {
  FaceTable faces(test::sheet(9, 8).mesh);
  test::Random random(1);
  int swaps = 0;
  for (int i = 0; i < 2000; ++i) {
    Star star;
    if (!faces.gather(random.below(72), star) || star.face_count() < 4) continue;
    const std::uint32_t place = random.below(star.count);
    if (!star.closed && (place == 0 || place + 1 == star.count)) continue;
    const Index s = star.ring[place == 0 ? star.count - 1 : place - 1];
    const Index t = star.ring[place + 1 == star.count ? 0 : place + 1];
    if (faces.has_edge(s, t)) continue;
    faces.swap(star, place);
    ++swaps;
  }
  EXPECT_GT(swaps, 300);
  const std::vector<Triangle> now = triangles(faces);
  const FaceTable fresh({72, now});
  EXPECT_EQ(test::invariants_of(now), test::invariants_of(test::sheet(9, 8).mesh.triangles));
  for (Index v = 0; v < 72; ++v) {
    std::vector<Index> a = ring(faces, v), b = ring(fresh, v);
    std::rotate(a.begin(), std::ranges::min_element(a), a.end());
    std::rotate(b.begin(), std::ranges::min_element(b), b.end());
    EXPECT_EQ(a, b) << v;
  }
  for (int round = 0; round < 2; ++round) {
    for (Index a = 0; a < 72; ++a)
      for (Index b = 0; b < a; ++b) EXPECT_EQ(faces.has_edge(a, b), fresh.has_edge(a, b)) << a << " " << b;
    faces.forget_old_edges();
  }
}

}  // namespace
}  // namespace limber
