// SPDX-License-Identifier: Apache-2.0
#include "limber/hierarchy/level_fit.h"

#include <gtest/gtest.h>

#include "eval/closest_point.h"
#include "limber/base/triangles.h"
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
  std::vector<Facing> facings;
  std::vector<Vec3d> minima;
  std::vector<double> quadric_errors;  // at the minima

  Levels(Shape given, double branching, Topology topology = Topology::kPreserve)
      : shape(std::move(given)),
        hierarchy(test::built(shape, branching, topology)),
        quadrics(hierarchy.node_count()),
        facings(hierarchy.node_count()),
        minima(hierarchy.node_count()),
        quadric_errors(hierarchy.node_count()) {
    place(shape.positions);
  }

  // The next frame.
  void place(std::span<const Vec3f> frame_positions) {
    const Normalization frame = normalization(shape.positions);
    for (Index v = 0; v < hierarchy.vertex_count(); ++v) minima[v] = frame.to_unit(frame_positions[v]);
    VertexQuadrics of_vertices(shape.mesh, {});
    of_vertices.compute(std::span(minima).first(hierarchy.vertex_count()),
                        std::span(quadrics).first(hierarchy.vertex_count()));
    std::fill(std::ranges::copy(of_vertices.facings(), facings.begin()).out, facings.end(), Facing{});
    std::fill(quadrics.begin() + hierarchy.vertex_count(), quadrics.end(), Quadric{});
    for (Index node = 0; node < hierarchy.node_count(); ++node)
      if (const Index parent = hierarchy.parent[node]; parent != kNone)
        quadrics[parent] += quadrics[node], facings[parent] += facings[node];
    for (Index node = hierarchy.vertex_count(); node < hierarchy.node_count(); ++node) {
      const QuadricMinimum at = minimum(quadrics[node]);
      minima[node] = at.point, quadric_errors[node] = at.value;
    }
  }

  struct Fitted {
    std::vector<Vec3d> positions;
    std::vector<double> errors;
  };
  Fitted fitted(LevelFit& fit, const FitOptions& options) const {
    Fitted fitted{minima, quadric_errors};
    fit.fit(quadrics, facings, options, fitted.positions, fitted.errors);
    return fitted;
  }
  std::vector<Vec3d> fitted(const FitOptions& options) const {
    LevelFit fit(shape.mesh, hierarchy);
    return fitted(fit, options).positions;
  }

  std::vector<Triangle> triangles(Index level) const {
    std::vector<Triangle> triangles;
    list_images(shape.mesh.triangles, test::ancestors(hierarchy, level), triangles);
    return triangles;
  }

  // The integral of the squared distance of the finest surface to a level's, wherever on it that is closest: a twelfth
  // of each triangle's area at every corner, the rest at its middle.
  double squared_distance(Index level, const std::vector<Vec3d>& positions) const {
    std::vector<Vec3f> corners;
    for (const Vec3d& p : positions) corners.push_back(static_cast<Vec3f>(p));
    const std::vector<Triangle> of_level = triangles(level);
    const eval::ClosestPointTree tree({of_level, corners});
    double sum = 0;
    const auto at = [&](const Vec3d& p) { return tree.closest(p).squared_distance; };
    for (Index v = 0; v < hierarchy.vertex_count(); ++v) sum += facings[v].area / 4 * at(positions[v]);
    for (const auto& [a, b, c] : shape.mesh.triangles) {
      const Vec3d &p = positions[a], &q = positions[b], &r = positions[c];
      sum += 0.75 * 0.5 * length(cross(q - p, r - p)) * at((p + q + r) * (1.0 / 3));
    }
    return sum;
  }

  // Triangles of a level that face away from the surface that their corners stand for, where that faces one way.
  int turned_over(Index level, const std::vector<Vec3d>& positions) const {
    const auto area_vector = [&](const Triangle& t) {
      return cross(positions[t[1]] - positions[t[0]], positions[t[2]] - positions[t[0]]);
    };
    const std::vector<Index> cluster = test::ancestors(hierarchy, level);
    std::vector<Vec3d> faces(hierarchy.node_count());
    for (const Triangle& t : shape.mesh.triangles)
      for (const Index vertex : t) faces[cluster[vertex]] += area_vector(t);
    std::vector<double> area(hierarchy.node_count());
    for (const Triangle& t : shape.mesh.triangles)
      for (const Index vertex : t) area[cluster[vertex]] += length(area_vector(t));
    int count = 0;
    for (const Triangle& t : triangles(level)) {
      const Vec3d sum = faces[t[0]] + faces[t[1]] + faces[t[2]];
      const bool faces_one_way = length(sum) > 0.75 * (area[t[0]] + area[t[1]] + area[t[2]]);
      count += faces_one_way && dot(area_vector(t), sum) < 0;
    }
    return count;
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
      EXPECT_LT(levels.squared_distance(level, thrice), 1.01 * levels.squared_distance(level, once))
          << "level " << level;
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

TEST(LevelFit, GoesNoFurtherThanHalfTheSideOfAFlatCluster) {
  Levels levels(waves(), 4);
  // A frame in which the clusters' borders have moved far along the surface.
  levels.place(moved(levels.shape, [](Vec3f p) {
                 return p + Vec3f{2 * std::sin(p.y), std::cos(2 * p.x), 0};
               }).positions);
  const std::vector<Vec3d> fitted = levels.fitted({.rounds = 6});
  int far_count = 0;
  for (std::size_t i = levels.hierarchy.vertex_count(); i < fitted.size(); ++i) {
    const auto& [vector, area] = levels.facings[i];
    if (length(vector) < 0.7 * area) continue;
    const double way = length(fitted[i] - levels.minima[i]);
    EXPECT_LT(way, 0.5 * std::sqrt(area / 0.7) * 1.001);
    far_count += way > 0.4 * std::sqrt(area);
  }
  EXPECT_GT(far_count, 0) << "nothing would have gone further";
}

TEST(LevelFit, GoesFurtherWhereAClusterIsATip) {
  // Two horns, back to back: the planes of their flanks meet below their ends.
  const Shape horns = moved(test::sphere(4), [](Vec3f p) {
    const float s = std::sqrt(std::max(0.0f, 1 - p.z * p.z));
    return Vec3f{0.3f * s * p.x, 0.3f * s * p.y, std::copysign(3 * (1 - s), p.z)};
  });
  const Levels levels(horns, 6);
  const std::vector<Vec3d> fitted = levels.fitted({.rounds = 6});
  int further_count = 0;
  for (std::size_t i = levels.hierarchy.vertex_count(); i < fitted.size(); ++i) {
    const auto& [vector, area] = levels.facings[i];
    const double side = std::sqrt(area), shadow = std::max(length(vector), area / 16);
    const double way = length(fitted[i] - levels.minima[i]);
    EXPECT_LE(way, 0.5 * area / std::sqrt(shadow) * 1.001);
    further_count += way > 0.55 * side;
  }
  EXPECT_GT(further_count, 0);
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

TEST(LevelFit, SaysAboutWhatSquaredDistanceIsLeft) {
  for (const Shape& shape : {bumpy(), waves()}) {
    const Levels levels(shape, 4);
    LevelFit fit(levels.shape.mesh, levels.hierarchy);
    const Levels::Fitted fitted = levels.fitted(fit, {.rounds = 3});
    for (Index level = 1; level < 3; ++level) {
      double sum = 0;
      for (Index node = levels.hierarchy.level_begin[level]; node < levels.hierarchy.level_begin[level + 1]; ++node)
        sum += fitted.errors[node];
      const double is = levels.squared_distance(level, fitted.positions);
      EXPECT_GT(sum, 0.9 * is) << "level " << level;
      EXPECT_LT(sum, 5 * is) << "level " << level;  // planes are farther than the surface
    }
  }
}

TEST(LevelFit, LeavesTheErrorsOfWhatHasNoTriangles) {
  Shape lonely = test::sheet(8, 8);
  lonely.mesh.vertex_count += 1;
  lonely.positions.push_back({20, 20, 20});
  Levels levels(std::move(lonely), 2);
  std::fill(levels.quadric_errors.begin(), levels.quadric_errors.end(), 7.0);
  LevelFit fit(levels.shape.mesh, levels.hierarchy);
  const Levels::Fitted fitted = levels.fitted(fit, {});
  Index node = levels.shape.mesh.vertex_count - 1;
  for (Index level = 0; level < levels.hierarchy.level_count(); ++level, node = levels.hierarchy.parent[node]) {
    EXPECT_EQ(fitted.errors[node], 7.0);
    EXPECT_EQ(fitted.positions[node], levels.minima[node]);
  }
  EXPECT_LT(fitted.errors[levels.hierarchy.level_begin[1]], 7.0);
}

TEST(LevelFit, GivesTheSameAgainAfterAnotherFrame) {
  Levels levels(bumpy(), 4);
  LevelFit fit(levels.shape.mesh, levels.hierarchy);
  const Levels::Fitted first = levels.fitted(fit, {});
  std::vector<Vec3f> between = levels.shape.positions;
  for (Vec3f& p : between) p.y += 0.1f * p.x;
  levels.place(between);
  EXPECT_NE(levels.fitted(fit, {}).positions, first.positions);
  levels.place(levels.shape.positions);
  const Levels::Fitted again = levels.fitted(fit, {});
  EXPECT_EQ(first.positions, again.positions);
  EXPECT_EQ(first.errors, again.errors);
}

TEST(LevelFit, TurnsNoTriangleOver) {
  const Shape folded = moved(test::sheet(40, 40), [](Vec3f p) {
    return Vec3f{p.x, p.y, 3 * std::sin(1.1f * p.x) * std::sin(0.9f * p.y) + 2 * std::sin(0.7f * p.x + 1.3f * p.y)};
  });
  const Levels levels(folded, 4);
  const std::vector<Vec3d> fitted = levels.fitted({.rounds = 4, .anchor = 1e-3});
  for (Index level = 1; level < levels.hierarchy.level_count(); ++level)
    EXPECT_LE(levels.turned_over(level, fitted), levels.turned_over(level, levels.minima)) << "level " << level;
}

}  // namespace
}  // namespace limber
