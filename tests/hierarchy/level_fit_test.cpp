// SPDX-License-Identifier: Apache-2.0
#include "limber/hierarchy/level_fit.h"

#include <gtest/gtest.h>

#include "eval/closest_point.h"
#include "limber/contract/vertex_quadrics.h"
#include "tests/support/hierarchies.h"

namespace limber {
namespace {

using test::Shape;

// A shape, a hierarchy over it and where its nodes stand before and after a fit.
struct Levels {
  Shape shape;
  Hierarchy hierarchy;
  std::vector<Quadric> quadrics;
  std::vector<double> areas;  // of the vertices
  std::vector<Vec3d> minima;

  Levels(Shape given, double branching, Topology topology = Topology::kPreserve)
      : shape(std::move(given)), hierarchy(test::built(shape, branching, topology)) {
    quadrics.resize(hierarchy.node_count());
    minima.resize(hierarchy.node_count());
    const Normalization frame = normalization(shape.positions);
    for (Index v = 0; v < hierarchy.vertex_count(); ++v) minima[v] = frame.to_unit(shape.positions[v]);
    VertexQuadrics of_vertices(shape.mesh, {});
    of_vertices.compute(std::span(minima).first(hierarchy.vertex_count()),
                        std::span(quadrics).first(hierarchy.vertex_count()));
    areas.assign(of_vertices.areas().begin(), of_vertices.areas().end());
    for (Index node = 0; node < hierarchy.node_count(); ++node)
      if (hierarchy.parent[node] != kNone) quadrics[hierarchy.parent[node]] += quadrics[node];
    for (Index node = hierarchy.vertex_count(); node < hierarchy.node_count(); ++node)
      minima[node] = minimum(quadrics[node]).point;
  }

  std::vector<Vec3d> fitted(const FitOptions& options) const {
    std::vector<Vec3d> positions = minima;
    LevelFit(shape.mesh, hierarchy).fit(areas, quadrics, options, positions);
    return positions;
  }

  // Sum of the squared distances of the finest vertices to a level's surface, wherever on it they are closest.
  double squared_distance(Index level, const std::vector<Vec3d>& positions) const {
    std::vector<Vec3f> corners;
    for (const Vec3d& p : positions) corners.push_back(static_cast<Vec3f>(p));
    const std::vector<Index> cluster = test::ancestors(hierarchy, level);
    std::vector<Triangle> triangles;
    for (const Triangle& t : shape.mesh.triangles) {
      const Triangle image{cluster[t[0]], cluster[t[1]], cluster[t[2]]};
      if (!is_degenerate(image)) triangles.push_back(image);
    }
    const eval::ClosestPointTree tree({triangles, corners});
    double sum = 0;
    for (Index v = 0; v < hierarchy.vertex_count(); ++v) sum += tree.closest(positions[v]).squared_distance;
    return sum;
  }
};

// A sphere with bumps, and an open sheet with waves.
Shape bumpy() {
  return moved(test::sphere(5), [](Vec3f p) { return p * (1 + 0.1f * std::sin(7 * p.x) * std::cos(5 * p.y + p.z)); });
}
Shape waves() {
  return moved(test::sheet(40, 40), [](Vec3f p) { return Vec3f{p.x, p.y, 2 * std::sin(0.3f * p.x + 0.1f * p.y)}; });
}

TEST(LevelFit, LeavesEverythingInItsPlaceInNoRounds) {
  const Levels levels(bumpy(), 4);
  EXPECT_EQ(levels.fitted({.rounds = 0}), levels.minima);
}

TEST(LevelFit, NeverMovesAFinestVertex) {
  const Levels levels(bumpy(), 4);
  const std::vector<Vec3d> fitted = levels.fitted({});
  for (Index v = 0; v < levels.hierarchy.vertex_count(); ++v) EXPECT_EQ(fitted[v], levels.minima[v]);
  EXPECT_NE(fitted, levels.minima);
}

TEST(LevelFit, BringsEveryLevelNearerToTheSurface) {
  for (const Shape& shape : {bumpy(), waves()}) {
    const Levels levels(shape, 4);
    const std::vector<Vec3d> once = levels.fitted({.rounds = 1}), thrice = levels.fitted({.rounds = 3});
    ASSERT_GT(levels.hierarchy.level_count(), 3u);
    for (Index level = 1; level + 1 < levels.hierarchy.level_count(); ++level) {
      const double before = levels.squared_distance(level, levels.minima);
      EXPECT_LT(levels.squared_distance(level, once), 0.9 * before) << "level " << level;
      EXPECT_LT(levels.squared_distance(level, thrice), levels.squared_distance(level, once)) << "level " << level;
    }
  }
}

TEST(LevelFit, KeepsAFlatSheetFlat) {
  const Levels levels(test::sheet(20, 20), 4);
  for (const Vec3d& p : levels.fitted({.rounds = 5})) EXPECT_NEAR(p.z, 0, 1e-12);
}

// Nodes are between what the samples ask for and the minima of their quadrics.
TEST(LevelFit, MovesLessWithAHeavierAnchor) {
  const Levels levels(bumpy(), 6);
  const auto moved_by = [&](double anchor) {
    const std::vector<Vec3d> fitted = levels.fitted({.rounds = 1, .anchor = anchor});
    double sum = 0;
    for (std::size_t i = 0; i < fitted.size(); ++i) sum += squared_length(fitted[i] - levels.minima[i]);
    return sum;
  };
  EXPECT_GT(moved_by(1), 10 * moved_by(100));
  EXPECT_GT(moved_by(100), 10 * moved_by(1e4));
}

TEST(LevelFit, BearsWhatIsNoSurface) {
  // Two triangles that lie on each other, one that is a line, one vertex alone, and an edge on three triangles.
  Shape odd;
  odd.mesh.vertex_count = 9;
  odd.mesh.triangles = {{0, 1, 2}, {0, 1, 2}, {2, 1, 3}, {4, 5, 6}, {1, 2, 7}};
  odd.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {5, 0, 0}, {6, 0, 0}, {7, 0, 0}, {1, 1, 1}, {3, 3, 3}};
  const Levels levels(std::move(odd), 2, Topology::kFree);
  for (const Vec3d& p : levels.fitted({.rounds = 10})) EXPECT_LT(length(p), 2);
}

TEST(LevelFit, GivesTheSameAgainAfterAnotherFrame) {
  const Levels levels(bumpy(), 4);
  LevelFit fit(levels.shape.mesh, levels.hierarchy);
  std::vector<Vec3d> first = levels.minima, between = levels.minima, again = levels.minima;
  for (Vec3d& p : between) p = p * 1.5 + Vec3d{0, 0.1 * p.x, 0};
  fit.fit(levels.areas, levels.quadrics, {}, first);
  fit.fit(levels.areas, levels.quadrics, {}, between);
  fit.fit(levels.areas, levels.quadrics, {}, again);
  EXPECT_EQ(first, again);
}

}  // namespace
}  // namespace limber
