// SPDX-License-Identifier: Apache-2.0
#include "limber/contract/contract.h"

#include <gtest/gtest.h>
#include <set>

#include "tests/support/shapes.h"
#include "tests/support/topology.h"

namespace limber {
namespace {

using test::Shape;

constexpr ContractOptions kFreely{.topology = Topology::kFree, .quadrics = {}, .fold_over_cosine = 0.2};

Simplified simplified(const Shape& shape, Index vertex_count, const ContractOptions& options = {}) {
  return simplify(shape.mesh, shape.positions, vertex_count, options);
}

Vec3d normal_of(const std::vector<Vec3f>& positions, const Triangle& t) {
  const Vec3d a = static_cast<Vec3d>(positions[t[0]]);
  return cross(static_cast<Vec3d>(positions[t[1]]) - a, static_cast<Vec3d>(positions[t[2]]) - a);
}

TEST(Simplify, ReachesExactlyTheVertexCountAskedFor) {
  const Shape ball = test::jittered(test::sphere(3), 0.01f, 1);
  for (const Index target : {258u, 257u, 100u, 17u, 4u}) {
    const Simplified result = simplified(ball, target);
    EXPECT_EQ(result.mesh.vertex_count, target);
    EXPECT_EQ(result.positions.size(), target);
    EXPECT_EQ(result.vertices.size(), target);
    EXPECT_EQ(result.mesh.triangles.size(), 2 * target - 4);
  }
}

TEST(Simplify, ToAtLeastAsManyVerticesChangesNothing) {
  const Shape ball = test::jittered(test::sphere(2), 0.01f, 2);
  const Simplified result = simplified(ball, 1000);
  ASSERT_EQ(result.mesh.vertex_count, ball.mesh.vertex_count);
  ASSERT_EQ(result.mesh.triangles.size(), ball.mesh.triangles.size());
  for (std::size_t t = 0; t < result.mesh.triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_EQ(result.vertices[result.mesh.triangles[t][i]], ball.mesh.triangles[t][i]);
  for (Index v = 0; v < result.mesh.vertex_count; ++v)
    EXPECT_NEAR(length(result.positions[v] - ball.positions[result.vertices[v]]), 0, 1e-6);
}

TEST(Simplify, KeepsASphereAClosedManifoldDownToATetrahedron) {
  const Shape ball = test::jittered(test::sphere(4), 0.01f, 3);
  for (const Index target : {500u, 60u, 10u, 4u, 1u}) {
    const Simplified result = simplified(ball, target);
    const test::Invariants now = test::invariants_of(result.mesh.triangles);
    EXPECT_EQ(now.vertex_count, std::max<long>(target, 4));
    EXPECT_TRUE(test::same_shape(now, test::invariants_of(ball.mesh.triangles))) << target;
  }
}

TEST(Simplify, StaysNearTheSurface) {
  const Simplified result = simplified(test::sphere(4), 100);
  for (const Vec3f& p : result.positions) EXPECT_NEAR(length(p), 1, 0.03);
  for (const Triangle& t : result.mesh.triangles) {
    const Vec3f middle = (result.positions[t[0]] + result.positions[t[1]] + result.positions[t[2]]) * (1.0f / 3);
    EXPECT_GT(dot(normal_of(result.positions, t), static_cast<Vec3d>(middle)), 0) << "it faces inwards";
  }
}

TEST(Simplify, KeepsABorderWhereItIs) {
  const Shape flat = test::sheet(21, 11);
  for (const Index target : {60u, 12u, 4u}) {
    const Simplified result = simplified(flat, target);
    EXPECT_TRUE(test::same_shape(test::invariants_of(result.mesh.triangles), test::invariants_of(flat.mesh.triangles)));
    double area = 0;
    for (const Triangle& t : result.mesh.triangles) area += 0.5 * length(normal_of(result.positions, t));
    EXPECT_NEAR(area, 200, 1) << target;
    for (const Vec3f& p : result.positions) {
      EXPECT_NEAR(p.z, 0, 1e-5);
      EXPECT_TRUE(p.x > -0.1f && p.x < 20.1f && p.y > -0.1f && p.y < 10.1f);
    }
  }
}

TEST(Simplify, KeepsHolesAndHandlesUntilNothingIsLeftToTake) {
  for (const Shape& shape : {test::waved(test::sheet_with_hole(16, 16)), test::torus(12, 30)}) {
    const Simplified result = simplified(shape, 1);
    EXPECT_TRUE(
        test::same_shape(test::invariants_of(result.mesh.triangles), test::invariants_of(shape.mesh.triangles)));
    EXPECT_LT(result.mesh.vertex_count, 12u);
  }
}

TEST(Contractor, GoesFurtherWhereTheTopologyIsFree) {
  const Shape shape = test::together(test::torus(8, 12), test::waved(test::sheet_with_hole(9, 9)), 20);
  const std::span<const Vec3f> frames[] = {shape.positions};
  Contractor careful(shape.mesh, frames, {}), free(shape.mesh, frames, kFreely);
  EXPECT_GT(careful.contract_to(1), 10u);
  EXPECT_EQ(free.contract_to(1), 2u) << "components are never joined";
}

TEST(Contractor, TheLargestCostOverFramesIsNotTheirSum) {
  // With a point for a quadric an edge costs half its squared length. Edge 0-1 is 1 long in both frames; edge 1-2 is
  // short in the first and a little longer than that in the second.
  const Mesh mesh{.vertex_count = 3, .triangles = {{0, 1, 2}}};
  const std::vector<Vec3f> close{{0, 0, 0}, {1, 0, 0}, {1.1f, 0.01f, 0}}, apart{{0, 0, 0}, {1, 0, 0}, {1, 1.1f, 0}};
  const std::span<const Vec3f> frames[] = {close, apart};
  const auto points_alone = [&](std::size_t f, std::span<Quadric> quadrics) {
    const Normalization normalize{normalization(frames[f]).center, normalization(frames[0]).scale};
    for (std::size_t v = 0; v < quadrics.size(); ++v) {
      quadrics[v] = {};
      quadrics[v].add_point(normalize.to_unit(frames[f][v]), 1);
    }
  };
  ContractOptions by_sum = kFreely, by_largest = kFreely;
  by_largest.frame_cost = FrameCost::kLargest;
  Contractor sum(mesh, frames, by_sum, {}, points_alone), largest(mesh, frames, by_largest, {}, points_alone);
  EXPECT_EQ(sum.contract_to(2), 2u);
  EXPECT_EQ(largest.contract_to(2), 2u);
  EXPECT_EQ(sum.representative(1), sum.representative(2));
  EXPECT_EQ(largest.representative(0), largest.representative(1));
}

TEST(Contractor, TheLargestCostOfEqualFramesGivesWhatOneOfThemGives) {
  const Shape ball = test::jittered(test::sphere(3), 0.05f, 9);
  const std::span<const Vec3f> frames[] = {ball.positions, ball.positions, ball.positions};
  Contractor one(ball.mesh, std::span(frames).first(1), {}),
      three(ball.mesh, frames, {.frame_cost = FrameCost::kLargest});
  one.contract_to(60);
  three.contract_to(60);
  for (Index v = 0; v < ball.mesh.vertex_count; ++v) EXPECT_EQ(one.representative(v), three.representative(v));
}

TEST(Contractor, QuadricsMayBeChangedBeforeItBegins) {
  const Shape ball = test::jittered(test::sphere(3), 0.05f, 10);
  const std::span<const Vec3f> frames[] = {ball.positions, ball.positions};
  const auto kept_above = [&](double weight) {
    const auto weigh = [&](std::size_t, std::span<Quadric> quadrics) {
      ASSERT_EQ(quadrics.size(), ball.positions.size());
      for (std::size_t v = 0; v < quadrics.size(); ++v)
        if (ball.positions[v].z > 0) quadrics[v] *= weight;
    };
    Contractor contractor(ball.mesh, frames, {}, {}, weigh);
    contractor.contract_to(60);
    Index count = 0;
    for (Index v = 0; v < ball.mesh.vertex_count; ++v)
      count += contractor.representative(v) == v && contractor.position(v, 1).z > 0;
    return count;
  };
  const Index alike = kept_above(1), above = kept_above(16), below = kept_above(1.0 / 16);
  EXPECT_GT(above, alike + 8);
  EXPECT_LT(below + 8, alike);
}

TEST(Contractor, GivesTheSameClustersWhereverTheMeshStands) {
  const Shape shape = test::quantized(test::jittered(test::waved(test::sheet(20, 20)), 0.2f, 7), 1024);
  const Simplified expected = simplified(shape, 50);
  for (const Vec3f& shift : {Vec3f{64, 0, 0}, Vec3f{-4096, 2048, 1024}}) {
    const Simplified result = simplified(moved(shape, [&](Vec3f p) { return p + shift; }), 50);
    EXPECT_EQ(result.mesh, expected.mesh);
    EXPECT_EQ(result.vertices, expected.vertices);
    for (Index v = 0; v < 50; ++v)
      EXPECT_NEAR(length(result.positions[v] - shift - expected.positions[v]), 0, 1e-3) << v;
  }
}

TEST(Contractor, IsAsGoodAtScalesThatAreNoPowersOfTwo) {
  const Shape ball = test::jittered(test::sphere(4), 0.002f, 8);
  for (const float scale : {1e-3f, 0.7f, 1e4f}) {
    const Simplified result = simplified(moved(ball, [&](Vec3f p) { return p * scale; }), 80);
    EXPECT_EQ(result.mesh.vertex_count, 80u);
    for (const Vec3f& p : result.positions) EXPECT_NEAR(length(p) / scale, 1, 0.04);
  }
}

TEST(Contractor, KeepsItsPlaceFarFromTheOrigin) {
  const Vec3f far{1e4f, -2e4f, 3e4f};
  const Simplified result = simplified(moved(test::sphere(3), [&](Vec3f p) { return p * 10 + far; }), 60);
  for (const Vec3f& p : result.positions) EXPECT_NEAR(length(p - far), 10, 0.5);
}

TEST(Contractor, DoesNotFoldAFlatSheetOver) {
  // Everything is cheap on a flat sheet: only the check keeps its triangles apart.
  const Shape flat = test::jittered(moved(test::sheet(30, 30), [](Vec3f p) { return p * 0.1f; }), 0.03f, 9);
  const Shape pressed = moved(flat, [](Vec3f p) { return Vec3f{p.x, p.y, 0}; });
  for (const Index target : {300u, 80u, 20u}) {
    const Simplified result = simplified(pressed, target);
    for (const Triangle& t : result.mesh.triangles) EXPECT_GE(normal_of(result.positions, t).z, -1e-6) << target;
  }
}

TEST(Contractor, FoldsOverWhereNothingElseIsLeft) {
  const Shape shape = test::jittered(test::sphere(3), 0.5f, 10);
  const Simplified result =
      simplified(shape, 4, {.topology = Topology::kPreserve, .quadrics = {}, .fold_over_cosine = 1});
  EXPECT_EQ(result.mesh.vertex_count, 4u);
}

TEST(Contractor, UnderEqualFramesChoosesAsUnderOne) {
  const Shape shape = test::jittered(test::sphere(3), 0.1f, 11);
  const std::span<const Vec3f> once[] = {shape.positions};
  const std::span<const Vec3f> twice[] = {shape.positions, shape.positions};
  Contractor one(shape.mesh, once, {}), two(shape.mesh, twice, {});
  one.contract_to(50), two.contract_to(50);
  for (Index v = 0; v < shape.mesh.vertex_count; ++v) ASSERT_EQ(one.representative(v), two.representative(v));
}

TEST(Contractor, KeepsWhatBendsInAnyFrame) {
  // Flat in the first frame; folded along the middle in the second.
  const Shape flat = test::sheet(21, 21);
  const Shape folded = moved(flat, [](Vec3f p) { return p.x <= 10 ? p : Vec3f{10, p.y, p.x - 10}; });
  const std::span<const Vec3f> frames[] = {flat.positions, folded.positions};
  Contractor contractor(flat.mesh, frames, {});
  contractor.contract_to(20);
  const Simplified first = simplified_mesh(contractor, flat.mesh, 0),
                   second = simplified_mesh(contractor, flat.mesh, 1);
  EXPECT_EQ(first.mesh, second.mesh);
  double area = 0;
  for (const Triangle& t : second.mesh.triangles) area += 0.5 * length(normal_of(second.positions, t));
  EXPECT_NEAR(area, 400, 8) << "the crease is cut off";
  for (const Vec3f& p : second.positions) EXPECT_LT(std::min(std::abs(p.z), std::abs(p.x - 10)), 0.3f);
}

TEST(Contractor, TakesOneFrameOfAnotherSizeThanTheFirst) {
  const Shape shape = test::jittered(test::sphere(2), 0.1f, 12);
  for (const float scale : {1e-6f, 1e6f}) {
    const Shape other = moved(shape, [&](Vec3f p) { return p * scale; });
    const std::span<const Vec3f> frames[] = {shape.positions, other.positions};
    Contractor contractor(shape.mesh, frames, {});
    EXPECT_EQ(contractor.contract_to(10), 10u);
    const Simplified result = simplified_mesh(contractor, shape.mesh, 1);
    for (const Vec3f& p : result.positions) EXPECT_NEAR(length(p) / scale, 1, 0.4);
  }
}

}  // namespace
}  // namespace limber
