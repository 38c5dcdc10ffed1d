// SPDX-License-Identifier: Apache-2.0
#include "limber/contract/vertex_quadrics.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <limits>

#include "tests/support/shapes.h"

namespace limber {
namespace {

using test::Random;
using test::Shape;

std::vector<Quadric> quadrics_of(const Mesh& mesh, const std::vector<Vec3d>& positions, QuadricOptions options = {}) {
  std::vector<Quadric> quadrics(mesh.vertex_count, Quadric{9, 9, 9, 9, 9, 9, 9, 9, 9, 9});
  VertexQuadrics(mesh, options).compute(positions, quadrics);
  return quadrics;
}

std::vector<Quadric> quadrics_of(const Shape& shape, QuadricOptions options = {}) {
  std::vector<Vec3d> positions;
  for (const Vec3f& p : shape.positions) positions.push_back(static_cast<Vec3d>(p));
  return quadrics_of(shape.mesh, positions, options);
}

std::vector<Vec3d> to_unit(const Shape& shape) {
  const Normalization n = normalization(shape.positions);
  std::vector<Vec3d> unit;
  for (const Vec3f& p : shape.positions) unit.push_back(n.to_unit(p));
  return unit;
}

// The quadric of neighbouring vertices 2 i and 2 i + 1, wherever they are.
std::vector<Vec3d> minima_of_pairs(const Mesh& mesh, const std::vector<Vec3d>& positions) {
  const std::vector<Quadric> quadrics = quadrics_of(mesh, positions);
  std::vector<Vec3d> minima;
  for (Index v = 0; v + 1 < mesh.vertex_count; v += 2) minima.push_back(minimum(quadrics[v] + quadrics[v + 1]).point);
  return minima;
}

TEST(Normalization, OfNoPointsAndOfCoincidentPointsHasScaleOne) {
  EXPECT_EQ(normalization({}).scale, 1.0);
  const std::vector<Vec3f> same(5, Vec3f{1e4f, 2, -3});
  EXPECT_EQ(normalization(same).scale, 1.0);
  EXPECT_EQ(normalization(same).center, (Vec3d{1e4, 2, -3}));
}

TEST(Normalization, BringsTheBoxToADiagonalOfOneAroundTheOriginAndBack) {
  for (const float scale : {1e-30f, 1e-3f, 1.0f, 1e4f, 1e30f}) {
    const Shape shape = moved(test::jittered(test::sphere(2), 0.1f, 1), [&](Vec3f p) {
      return (p + Vec3f{3, -2, 7}) * scale;
    });
    const Normalization n = normalization(shape.positions);
    Box box;
    for (const Vec3f& p : shape.positions) {
      box.add(n.to_unit(p));
      EXPECT_NEAR(length(n.from_unit(n.to_unit(p)) - p) / scale, 0, 1e-6);
    }
    EXPECT_NEAR(box.diagonal(), 1, 1e-12);
    EXPECT_NEAR(length(box.center()), 0, 1e-12);
  }
}

TEST(Normalization, OfTheSmallestFloatsIsFinite) {
  const std::vector<Vec3f> tiny = {{0, 0, 0}, {std::numeric_limits<float>::denorm_min(), 0, 0}};
  EXPECT_TRUE(std::isfinite(normalization(tiny).scale));
  EXPECT_TRUE(is_finite(normalization(tiny).to_unit(tiny[1])));
}

TEST(VertexQuadrics, OfAFlatSquareWeighItsAreaAcrossAndNextToNothingAlong) {
  const Shape flat = test::sheet(3, 3);
  const Quadric middle = quadrics_of(flat, {.border_weight = 1, .point_weight = 1e-4})[4];
  const Vec3d p = static_cast<Vec3d>(flat.positions[4]);
  const double area = 1;  // a third of six triangles of area one half
  EXPECT_NEAR(middle(p), 0, 1e-14);
  EXPECT_NEAR(middle(p + Vec3d{0, 0, 2}), 4 * area * (1 + 1e-4), 1e-12);
  EXPECT_NEAR(middle(p + Vec3d{3, 0, 0}), 9 * area * 1e-4, 1e-12);
}

TEST(VertexQuadrics, ShareOutTheWholeArea) {
  const Shape shape = test::waved(test::sheet(8, 5));
  double area = 0, trace = 0;
  for (const auto& [a, b, c] : shape.mesh.triangles)
    area += 0.5 * length(cross(static_cast<Vec3d>(shape.positions[b]) - static_cast<Vec3d>(shape.positions[a]),
                               static_cast<Vec3d>(shape.positions[c]) - static_cast<Vec3d>(shape.positions[a])));
  for (const Quadric& q : quadrics_of(shape, {.border_weight = 0, .point_weight = 1e-4})) trace += q.trace();
  EXPECT_NEAR(trace, area * (1 + 3e-4), 1e-9);
}

TEST(VertexQuadrics, HoldABorderInPlaceButLetItsVerticesSlideAlong) {
  const Shape flat = test::sheet(3, 3);
  const Quadric on_border = quadrics_of(flat, {.border_weight = 2, .point_weight = 1e-9})[1];
  const Vec3d p = static_cast<Vec3d>(flat.positions[1]);
  EXPECT_NEAR(on_border(p + Vec3d{0, 1, 0}), 2, 1e-6);  // two border edges of length one, half of each
  EXPECT_NEAR(on_border(p + Vec3d{1, 0, 0}), 0, 1e-6);
  const Quadric free = quadrics_of(flat, {.border_weight = 0, .point_weight = 1e-9})[1];
  EXPECT_NEAR(free(p + Vec3d{0, 1, 0}), 0, 1e-6);
}

TEST(VertexQuadrics, DoNotCareWhichWayTrianglesFace) {
  Shape shape = test::waved(test::sheet(6, 6));
  const std::vector<Quadric> before = quadrics_of(shape);
  for (Triangle& t : shape.mesh.triangles) std::swap(t[1], t[2]);
  const std::vector<Quadric> after = quadrics_of(shape);
  Random random(1);
  for (Index v = 0; v < shape.mesh.vertex_count; ++v) {
    const Vec3d x = static_cast<Vec3d>(random.point());
    EXPECT_NEAR(before[v](x), after[v](x), 1e-9);
  }
}

TEST(VertexQuadrics, AreSmallestAtTheVertexItself) {
  for (const Shape& shape : {test::jittered(test::sphere(3), 0.05f, 2), test::waved(test::sheet(9, 9)),
                             test::tetrahedron(), test::torus(5, 9)}) {
    const std::vector<Vec3d> unit = to_unit(shape);
    const std::vector<Quadric> quadrics = quadrics_of(shape.mesh, unit);
    for (Index v = 0; v < shape.mesh.vertex_count; ++v)
      EXPECT_NEAR(length(minimum(quadrics[v]).point - unit[v]), 0, 1e-9) << v;
  }
}

// Isolated vertices, vertices of degenerate triangles only, needles, everything in one point.
TEST(VertexQuadrics, GiveEveryVertexAPlaceOfItsOwn) {
  const Mesh mesh{9, {{0, 1, 2}, {2, 3, 3}, {4, 4, 4}, {4, 5, 6}, {0, 2, 7}, {1, 0, 1}}};
  const std::vector<std::vector<Vec3d>> frames = {
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {.2, .2, 0}, {.3, .1, .7}, {.3, .1, .7}, {.3, .1, .7}, {.5, 0, .5}, {1, 1, 1}},
      {{0, 0, 0}, {1, 0, 0}, {.5, 1e-13, 0}, {.2, .2, 0}, {0, 0, 1}, {0, 0, .5}, {0, 0, .25}, {1, 1e-9, 0}, {1, 1, 1}},
      {{-.5, -.5, -.5},
       {.1, .1, .1},
       {.2, .2, .2},
       {.3, .3, .3},
       {.4, .4, .4},
       {-.4, -.4, -.4},
       {0, 0, 0},
       {.5, .5, .5},
       {-.1, -.1, -.1}},
      std::vector<Vec3d>(9, Vec3d{}),
  };
  Random random(3);
  for (std::size_t f = 0; f < frames.size(); ++f) {
    const std::vector<Quadric> quadrics = quadrics_of(mesh, frames[f]);
    for (Index v = 0; v < mesh.vertex_count; ++v) {
      const QuadricMinimum at = minimum(quadrics[v]);
      EXPECT_NEAR(length(at.point - frames[f][v]), 0, 1e-3) << "frame " << f << ", vertex " << v;
      for (int i = 0; i < 50; ++i)
        EXPECT_GT(quadrics[v](frames[f][v] + static_cast<Vec3d>(random.point()) * 10), at.value) << f << " " << v;
    }
  }
}

// A clip may fold a surface to a line in one frame. Rounding then gives its triangles areas and normals of pure chance.
TEST(VertexQuadrics, PlaceClustersOfASurfaceFoldedToALineOnThatLine) {
  for (const Vec3f direction : {Vec3f{1, 0, 0}, {1, 1, 1}, {0.3f, -0.7f, 0.11f}, {0.5f, 0.25f, 3}}) {
    const Shape line = moved(test::sheet(12, 12), [&](Vec3f p) { return direction * (p.x + 0.37f * p.y); });
    const std::vector<Vec3d> unit = to_unit(line);
    const Vec3d along = unit.back() * (1 / length(unit.back()));
    for (const Vec3d& p : minima_of_pairs(line.mesh, unit)) {
      EXPECT_NEAR(length(p - along * dot(p, along)), 0, 1e-3) << direction.x;
      EXPECT_LT(length(p), 0.6) << direction.x;
    }
  }
}

TEST(VertexQuadrics, PlaceNeedlesAtTheBorderOfALargeMeshAmongTheirVertices) {
  // Flat needles of decreasing height, each with its two long edges on a border, beside a sheet of many vertices.
  for (const double height : {1e-6, 1e-9, 1e-12, 1e-15}) {
    const Shape many = test::sheet(100, 100);
    Mesh mesh = many.mesh;
    std::vector<Vec3d> positions;
    for (const Vec3f& p : many.positions) positions.push_back(static_cast<Vec3d>(p) * 0.005);
    const Vec3d at{-0.3, 0.2, 0.1}, along{0.35, 0.4, 0.1}, across = cross(along, {0.3, -0.2, 0.5});
    for (const Vec3d& p : {at, at + along, at + across * height}) positions.push_back(p);
    mesh.triangles.push_back({10000, 10001, 10002});
    mesh.vertex_count += 3;
    const std::vector<Quadric> quadrics = quadrics_of(mesh, positions);
    const Vec3d p = minimum(quadrics[10000] + quadrics[10002]).point;
    EXPECT_NEAR(length(p - at), 0, 1e-2 + height) << height;
  }
}

TEST(VertexQuadrics, GiveTheSameMinimaAtEveryScaleAndPlace) {
  const Shape shape = test::jittered(test::waved(test::sheet(12, 10)), 0.1f, 5);
  const std::vector<Vec3d> expected = minima_of_pairs(shape.mesh, to_unit(shape));
  for (const float scale : {1e-3f, 0.3f, 7.0f, 1e4f}) {
    for (const float shift : {0.0f, 10.0f}) {
      const Shape other = moved(shape, [&](Vec3f p) { return (p + Vec3f{shift, -shift, shift}) * scale; });
      const std::vector<Vec3d> minima = minima_of_pairs(other.mesh, to_unit(other));
      for (std::size_t i = 0; i < minima.size(); ++i)
        EXPECT_NEAR(length(minima[i] - expected[i]), 0, 1e-4) << scale << " " << shift;
    }
  }
}

TEST(VertexQuadrics, ForgetTheFrameBefore) {
  const Shape shape = test::waved(test::sheet(5, 5));
  const std::vector<Vec3d> first = to_unit(shape), second(first.size(), Vec3d{0.1, 0.2, 0.3});
  VertexQuadrics of(shape.mesh, {});
  std::vector<Quadric> once(shape.mesh.vertex_count), again(shape.mesh.vertex_count);
  of.compute(first, once);
  of.compute(second, again);
  of.compute(first, again);
  EXPECT_EQ(once, again);
}

}  // namespace
}  // namespace limber
