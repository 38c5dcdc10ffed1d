// SPDX-License-Identifier: Apache-2.0
#include "limber/hierarchy/build.h"

#include <gtest/gtest.h>

#include "limber/hierarchy/validate.h"
#include "tests/support/hierarchies.h"

namespace limber {
namespace {

using test::Shape;

Hierarchy build(const Shape& shape, const BuildOptions& options = {}) {
  const std::span<const Vec3f> frames[] = {shape.positions};
  return build_hierarchy(shape.mesh, frames, options);
}

void expect_valid(const Mesh& mesh, const Hierarchy& hierarchy, Topology topology = Topology::kPreserve) {
  const auto violation = Validator(mesh, topology)(hierarchy);
  EXPECT_FALSE(violation) << violation->line();
}

TEST(LevelTargets, ShrinkByTheBranchingFactorDownToTheSmallestLevel) {
  BuildOptions options;
  options.branching = 8;
  EXPECT_EQ(level_targets(8431, options), (std::vector<Index>{1054, 132, 16}));
  options.branching = 2;
  EXPECT_EQ(level_targets(100, options), (std::vector<Index>{50, 25, 13}));
  EXPECT_TRUE(level_targets(10, options).empty());
  EXPECT_TRUE(level_targets(0, options).empty());
  options.branching = 100;
  options.level_sizes = {77, 3};
  EXPECT_EQ(level_targets(100, options), (std::vector<Index>{77, 3}));
}

TEST(BuildHierarchy, HasTheLevelsThatTheTargetsSay) {
  const Shape ball = test::jittered(test::sphere(4), 0.01f, 1);  // 1026 vertices
  BuildOptions options;
  options.branching = 8;
  const Hierarchy h = build(ball, options);
  EXPECT_EQ(h.level_begin, (std::vector<Index>{0, 1026, 1026 + 128, 1026 + 128 + 16}));
  expect_valid(ball.mesh, h);
}

TEST(BuildAlike, IsWhatBuildHierarchyMakesOfTheSameFrame) {
  Shape ball = test::jittered(test::sphere(4), 0.01f, 1);
  ball.mesh.vertex_count += 1;  // isolated
  ball.positions.push_back({5, 5, 5});
  const Hierarchy h = build(ball, {.branching = 3});
  EXPECT_EQ(build_alike(ball.mesh, ball.positions, h, {}), h);
  const Shape other = test::jittered(ball, 0.1f, 2);
  const std::optional<Hierarchy> alike = build_alike(ball.mesh, other.positions, h, {});
  ASSERT_TRUE(alike);
  EXPECT_EQ(alike->level_begin, h.level_begin);
  EXPECT_NE(alike->parent, h.parent);
  expect_valid(ball.mesh, *alike);
}

TEST(BuildAlike, IsNotWhereTheMeshCannotBeContractedThatFar) {
  const Shape ring = test::torus(9, 24);
  BuildOptions options{.branching = 100};
  options.level_sizes = {50, 2};
  options.contract.topology = Topology::kFree;
  const Hierarchy h = build(ring, options);
  ASSERT_EQ(h.level_size(2), 2u);
  EXPECT_TRUE(build_alike(ring.mesh, ring.positions, h, options.contract));
  EXPECT_FALSE(build_alike(ring.mesh, ring.positions, h, {}));
}

TEST(BuildHierarchy, HasTheExactLevelSizesAskedFor) {
  const Shape ball = test::jittered(test::sphere(3), 0.01f, 2);
  BuildOptions options;
  options.branching = 100;
  options.level_sizes = {100, 99, 31, 5};
  const Hierarchy h = build(ball, options);
  ASSERT_EQ(h.level_count(), 5u);
  for (Index level = 1; level < 5; ++level) EXPECT_EQ(h.level_size(level), options.level_sizes[level - 1]);
  expect_valid(ball.mesh, h);
}

TEST(BuildHierarchy, LeavesOutLevelsThatWouldEqualTheOneBelow) {
  const Shape ball = test::jittered(test::sphere(2), 0.01f, 3);
  BuildOptions options;
  options.branching = 100;
  options.level_sizes = {1000, 66, 30, 3, 2};  // as many as there are and more; fewer than a closed surface can have
  const Hierarchy h = build(ball, options);
  EXPECT_EQ(h.level_begin, (std::vector<Index>{0, 66, 96, 100}));
  expect_valid(ball.mesh, h);
}

TEST(BuildHierarchy, AsksOftenWhetherToGoOnAndStopsAtTheFirstNo) {
  const Shape ball = test::jittered(test::sphere(5), 0.01f, 6);  // 4,098 vertices, 12,288 edges
  const std::span<const Vec3f> frames[] = {ball.positions, ball.positions};
  int asked_in_all = 0;
  const Result<Hierarchy> whole = build_hierarchy(ball.mesh, frames, {}, [&] { return ++asked_in_all > 0; });
  ASSERT_TRUE(whole);
  EXPECT_EQ(*whole, build_hierarchy(ball.mesh, frames, {}));
  // Once for each 1024 edges that are priced for the first time or contracted, besides the frames.
  EXPECT_GE(asked_in_all, 2 + (12288 + 4086) / 1024);
  EXPECT_LT(asked_in_all, 100);
  for (int at = 1; at <= asked_in_all; ++at) {
    int asked = 0;
    const Result<Hierarchy> stopped = build_hierarchy(ball.mesh, frames, {}, [&] { return ++asked < at; });
    ASSERT_FALSE(stopped) << at;
    EXPECT_EQ(stopped.error().code, ErrorCode::kCancelled);
    EXPECT_EQ(asked, at);
  }
}

TEST(BuildHierarchy, NumbersTheNodesOfALevelByTheirFirstVertex) {
  const Hierarchy h = build(test::jittered(test::sphere(4), 0.01f, 4));
  for (Index level = 1; level < h.level_count(); ++level) {
    Index next = h.level_begin[level];
    for (const Index node : test::ancestors(h, level)) {
      ASSERT_LE(node, next);
      next += node == next;
    }
    EXPECT_EQ(next, h.level_begin[level + 1]);
  }
}

TEST(BuildHierarchy, GivesIsolatedVerticesANodeOnEveryLevel) {
  Shape shape = test::jittered(test::sphere(3), 0.01f, 5);
  shape.positions.insert(shape.positions.begin(), {Vec3f{4, 0, 0}, Vec3f{5, 0, 0}});
  shape.positions.push_back({6, 0, 0});
  shape.mesh.vertex_count += 3;
  for (Triangle& t : shape.mesh.triangles)
    for (Index& corner : t) corner += 2;
  BuildOptions options;
  options.branching = 100;
  options.level_sizes = {50, 10};
  const Hierarchy h = build(shape, options);
  EXPECT_EQ(h.level_size(1), 53u);
  EXPECT_EQ(h.level_size(2), 13u);
  expect_valid(shape.mesh, h);
}

TEST(BuildHierarchy, OfAMeshTooSmallToContractIsOneLevel) {
  EXPECT_EQ(build(test::tetrahedron()).level_count(), 1u);
  EXPECT_EQ(build({{3, {}}, {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}}).level_count(), 1u);
  const Hierarchy nothing = build({});
  EXPECT_EQ(nothing.level_count(), 1u);
  EXPECT_EQ(nothing.node_count(), 0u);
}

TEST(BuildHierarchy, IsValidOnEveryShapeInBothTopologies) {
  const Shape shapes[] = {test::torus(8, 20), test::waved(test::sheet(20, 20)),
                          test::waved(test::sheet_with_hole(15, 15)),
                          test::together(test::sphere(2), test::torus(5, 9), 9)};
  for (const Shape& shape : shapes) {
    for (const Topology topology : {Topology::kPreserve, Topology::kFree}) {
      for (const double branching : {1.5, 3.0, 8.0}) {
        const Hierarchy h = test::built(shape, branching, topology);
        EXPECT_GE(h.level_count(), 2u);
        expect_valid(shape.mesh, h, topology);
      }
    }
  }
}

TEST(BuildHierarchy, FollowsAllFramesGiven) {
  const Shape flat = test::sheet(21, 21);
  const Shape folded = moved(flat, [](Vec3f p) { return p.x <= 10 ? p : Vec3f{10, p.y, p.x - 10}; });
  const std::span<const Vec3f> one[] = {flat.positions}, both[] = {flat.positions, folded.positions};
  EXPECT_NE(build_hierarchy(flat.mesh, one, {}), build_hierarchy(flat.mesh, both, {}));
}

}  // namespace
}  // namespace limber
