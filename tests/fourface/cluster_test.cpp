// SPDX-License-Identifier: Apache-2.0
#include "limber/fourface/cluster.h"

#include <gtest/gtest.h>
#include <optional>
#include <vector>

#include "limber/contract/vertex_quadrics.h"
#include "tests/support/shapes.h"

namespace limber {
namespace {

struct Prepared {
  Prepared(const Mesh& mesh, const std::vector<Vec3d>& points, std::size_t frame_count = 1)
      : faces(mesh), errors(mesh, points, frame_count, QuadricOptions{}) {}
  std::optional<ClusterPlan> plan(Index v, const ClusterOptions& options = {}) const {
    Star star;
    ClusterPlan made;
    if (!faces.gather(v, star) || !plan_cluster({faces, errors}, star, options, made)) return std::nullopt;
    return made;
  }
  Index neighbour(Index v, std::uint8_t place) const {
    Star star;
    faces.gather(v, star);
    return star.ring[place];
  }

  FaceTable faces;
  VertexErrors errors;
};

std::vector<Vec3d> hexagon_points() {
  return {{0, 0, 0}, {2, 0, 0}, {1, 2, 0}, {-1, 2, 0}, {-2, 0, 0}, {-1, -2, 0}, {1, -2, 0}};
}
Mesh hexagon() { return {7, {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 6}, {0, 6, 1}}}; }

TEST(Cluster, OfSixFacesTakesTwoSwaps) {
  const auto plan = Prepared(hexagon(), hexagon_points()).plan(0);
  ASSERT_TRUE(plan);
  EXPECT_EQ(plan->swap_count, 2);
  EXPECT_NE(plan->kept, plan->opposite);
}

TEST(Cluster, CostsMoreTheFartherTheVertexIsFromTheSurfaceThatIsLeft) {
  std::vector<Vec3d> points = hexagon_points();
  const double flat = Prepared(hexagon(), points).plan(0)->cost;
  points[0].z = 0.2;
  const double low = Prepared(hexagon(), points).plan(0)->cost;
  points[0].z = 0.4;
  EXPECT_GT(low, flat);
  EXPECT_GT(Prepared(hexagon(), points).plan(0)->cost, low);
}

TEST(Cluster, OnABorderIsRemovedAlongIt) {
  const Prepared sheet(test::sheet(3, 2).mesh, {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0}});
  const auto plan = sheet.plan(1);
  ASSERT_TRUE(plan);
  EXPECT_EQ(sheet.neighbour(1, plan->kept) + sheet.neighbour(1, plan->opposite), 0u + 2u);
}

TEST(Cluster, WithOneFaceStays) { EXPECT_FALSE(Prepared({3, {{0, 1, 2}}}, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}).plan(0)); }

TEST(Cluster, OfATetrahedronStays) {
  const test::Shape shape = test::tetrahedron();
  std::vector<Vec3d> points;
  for (const Vec3f& p : shape.positions) points.push_back(static_cast<Vec3d>(p));
  const Prepared prepared(shape.mesh, points);
  for (Index v = 0; v < 4; ++v) EXPECT_FALSE(prepared.plan(v));
}

// The edge (0, 1) runs along a line that ends in the centre.
TEST(Cluster, WhereALineEndsStays) {
  Prepared prepared(hexagon(), hexagon_points());
  prepared.faces.tag_edge(0, 1);
  EXPECT_FALSE(prepared.plan(0));
}

TEST(Cluster, OnALineIsRemovedAlongIt) {
  Prepared prepared(hexagon(), hexagon_points());
  prepared.faces.tag_edge(0, 1);
  prepared.faces.tag_edge(0, 4);
  const auto plan = prepared.plan(0);
  ASSERT_TRUE(plan);
  EXPECT_EQ(prepared.neighbour(0, plan->kept) + prepared.neighbour(0, plan->opposite), 1u + 4u);
  for (std::uint32_t i = 0; i < plan->swap_count; ++i) {
    EXPECT_NE(prepared.neighbour(0, plan->swaps[i]), 1u);
    EXPECT_NE(prepared.neighbour(0, plan->swaps[i]), 4u);
  }
}

// Vertex 3 lies so far in that the triangles (2, 3, 4) of every way around would lie upside down.
TEST(Cluster, IsNotFoldedOver) {
  const Mesh mesh{5, {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}}};
  const std::vector<Vec3d> points{{0, -0.5, 0}, {0, -2, 0}, {2, 1, 0}, {0, -0.4, 0}, {-2, 1, 0}};
  const auto plan = Prepared(mesh, points).plan(0);
  ASSERT_TRUE(plan);
  const Prepared prepared(mesh, points);
  EXPECT_EQ(prepared.neighbour(0, plan->kept) + prepared.neighbour(0, plan->opposite), 1u + 3u);
}

// Flat in the first frame; in the second the centre stands out.
TEST(Cluster, CostsWhatItDoesInAllFramesTogether) {
  const std::vector<Vec3d> flat = hexagon_points();
  std::vector<Vec3d> bent = flat, both;
  bent[0].z = 0.5;
  for (std::size_t v = 0; v < flat.size(); ++v) both.push_back(flat[v]), both.push_back(bent[v]);
  const auto once = Prepared(hexagon(), bent).plan(0), twice = Prepared(hexagon(), both, 2).plan(0);
  ASSERT_TRUE(once && twice);
  EXPECT_GE(twice->cost, once->cost);
  EXPECT_LE(twice->cost, 2 * once->cost);
}

}  // namespace
}  // namespace limber
