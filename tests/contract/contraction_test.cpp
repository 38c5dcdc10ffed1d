// SPDX-License-Identifier: Apache-2.0
// What holds for every placement.
#include "limber/contract/contraction.h"

#include <ctime>
#include <gtest/gtest.h>

#include "limber/contract/contract.h"
#include "tests/support/shapes.h"

namespace limber {
namespace {

using test::Shape;

class EveryContraction : public testing::TestWithParam<Placement> {
 protected:
  static ContractOptions options(Topology topology = Topology::kPreserve) {
    return {.topology = topology, .quadrics = {}, .placement = GetParam()};
  }
  static std::unique_ptr<Contraction> start(const Shape& shape) {
    return start_contraction(shape.mesh, shape.positions, options());
  }
  static Simplified simplified(const Shape& shape, Index vertex_count) {
    return simplify(shape.mesh, shape.positions, vertex_count, options());
  }
};

TEST_P(EveryContraction, GivesTheSameWhetherItStopsOnTheWayOrNot) {
  const Shape ball = test::jittered(test::sphere(3), 0.05f, 4);
  const auto at_once = start(ball), by_steps = start(ball);
  EXPECT_EQ(at_once->contract_to(40), 40u);
  for (const Index target : {200u, 199u, 199u, 250u, 100u, 41u, 40u}) by_steps->contract_to(target);
  for (Index v = 0; v < ball.mesh.vertex_count; ++v) {
    const Index r = at_once->representative(v);
    ASSERT_EQ(r, by_steps->representative(v));
    EXPECT_EQ(r, at_once->representative(r));
    EXPECT_EQ(at_once->position(r, 0), by_steps->position(r, 0));
  }
}

TEST_P(EveryContraction, GivesTheSameTwice) {
  const Shape shape = test::jittered(test::sphere(3), 0.1f, 5);
  const Simplified a = simplified(shape, 50), b = simplified(shape, 50);
  EXPECT_EQ(a.mesh, b.mesh);
  EXPECT_EQ(a.positions, b.positions);
  EXPECT_EQ(a.vertices, b.vertices);
}

TEST_P(EveryContraction, GivesTheSameAtAnyScaleThatIsAPowerOfTwo) {
  const Shape shape = test::jittered(test::waved(test::sheet(20, 20)), 0.2f, 6);
  const Simplified expected = simplified(shape, 50);
  for (const float scale : {0x1p-30f, 0x1p-10f, 2.0f, 0x1p13f, 0x1p30f}) {
    const Simplified result = simplified(moved(shape, [&](Vec3f p) { return p * scale; }), 50);
    EXPECT_EQ(result.mesh, expected.mesh);
    for (Index v = 0; v < 50; ++v) EXPECT_EQ(result.positions[v], expected.positions[v] * scale);
  }
}

TEST_P(EveryContraction, LeavesIsolatedVerticesAloneAndUncounted) {
  Shape shape = test::sphere(2);
  shape.mesh.vertex_count += 3;
  for (const float x : {5.0f, 6.0f, 7.0f}) shape.positions.push_back({x, 0, 0});
  const auto contraction = start(shape);
  EXPECT_EQ(contraction->vertex_count(), 66u);
  EXPECT_EQ(contraction->contract_to(10), 10u);
  for (Index v = 66; v < 69; ++v) {
    EXPECT_EQ(contraction->representative(v), v);
    EXPECT_NEAR(length(contraction->position(v, 0) - shape.positions[v]), 0, 1e-5);
  }
  EXPECT_EQ(simplified_mesh(*contraction, shape.mesh, 0).mesh.vertex_count, 10u);
}

TEST_P(EveryContraction, TakesMeshesWithNothingToContract) {
  for (const Mesh& mesh : {Mesh{}, Mesh{3, {}}, Mesh{3, {{0, 0, 1}, {2, 2, 2}}}}) {
    const std::vector<Vec3f> positions(mesh.vertex_count, Vec3f{1, 2, 3});
    EXPECT_TRUE(simplify(mesh, positions, 1, options(Topology::kFree)).mesh.triangles.empty());
  }
}

TEST_P(EveryContraction, TakesASurfaceWithoutExtent) {
  Shape shape = test::sphere(2);
  for (const bool line : {false, true}) {
    for (Index v = 0; v < shape.mesh.vertex_count; ++v)
      shape.positions[v] = line ? Vec3f{0.3f, 0.7f, -0.2f} * static_cast<float>(v) : Vec3f{4, 5, 6};
    const Simplified result = simplified(shape, 8);
    EXPECT_EQ(result.mesh.vertex_count, 8u);
    for (const Vec3f& p : result.positions) {
      EXPECT_TRUE(is_finite(p));
      EXPECT_LT(length(p), line ? 60.0f : 9.0f);
    }
  }
}

TEST_P(EveryContraction, TakesAFanOfManyTrianglesInReasonableTime) {
  constexpr Index kRim = 10000;
  Shape fan{{kRim + 1, {}}, {{0, 0, 0.1f}}};
  for (Index i = 0; i < kRim; ++i) {
    const float turn = 6.2831853f * static_cast<float>(i) / kRim;
    fan.positions.push_back({std::cos(turn), std::sin(turn), 0});
    fan.mesh.triangles.push_back({0, 1 + i, 1 + (i + 1) % kRim});
  }
  const std::clock_t start = std::clock();  // of the processor: others may be busy, too
  EXPECT_EQ(simplified(fan, 10).mesh.vertex_count, 10u);
  EXPECT_LT(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC, 20);
}

INSTANTIATE_TEST_SUITE_P(Contraction, EveryContraction, testing::Values(Placement::kQuadric, Placement::kVolume),
                         [](const auto& tested) {
                           return std::string(tested.param == Placement::kQuadric ? "ByQuadrics" : "ByVolume");
                         });

}  // namespace
}  // namespace limber
