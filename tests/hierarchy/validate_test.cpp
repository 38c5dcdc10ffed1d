// SPDX-License-Identifier: Apache-2.0
#include "limber/hierarchy/validate.h"

#include <gtest/gtest.h>

#include "tests/support/hierarchies.h"

namespace limber {
namespace {

using test::Shape;

// Two strips of a sheet on level 1, one node on level 2.
const std::vector<std::string> kRows = {"aabb", "aabb", "ccdd", "ccdd"};
const Mesh kMesh = test::sheet(4, 4).mesh;
const Hierarchy kSound = test::drawn(kRows, "xyyx");

std::string found(const Hierarchy& h, const Mesh& mesh = kMesh, Topology topology = Topology::kFree) {
  const auto violation = Validator(mesh, topology)(h);
  return violation ? violation->line() : "nothing";
}

TEST(Validator, FindsNothingWrongWithASoundHierarchy) {
  EXPECT_EQ(found(test::drawn(kRows)), "nothing");
  EXPECT_EQ(found(test::drawn(kRows), kMesh, Topology::kPreserve), "nothing");
  EXPECT_EQ(found({{0, 16}, std::vector<Index>(16, kNone)}, kMesh, Topology::kPreserve), "nothing");
  EXPECT_EQ(found({{0, 0}, {}}, {}, Topology::kPreserve), "nothing");
}

TEST(Validator, SaysInOneLineWhatIsBrokenAndWhere) {
  EXPECT_EQ((Violation{"cluster-connected", 2, 9481}.line()), "cluster-connected is broken at level 2, node 9481");
  EXPECT_EQ((Violation{"levels-nested", 0, kNone}.line()), "levels-nested is broken at level 0");
}

TEST(Validator, FindsLevelsThatAreNotNested) {
  const std::string expected = "levels-nested is broken at level 0";
  const Hierarchy sound = test::drawn(kRows);
  EXPECT_EQ(found({}), expected);
  EXPECT_EQ(found({{0}, {}}), expected);
  EXPECT_EQ(found({{1, 16, 20}, sound.parent}), expected);
  EXPECT_EQ(found({{0, 15, 20}, sound.parent}), expected) << "another vertex count than the mesh";
  EXPECT_EQ(found({{0, 16, 21}, sound.parent}), expected) << "more nodes than parents";
  EXPECT_EQ(found({{0, 16, 19}, sound.parent}), expected);
  EXPECT_EQ(found({{0, 16, 22, 20}, sound.parent}), expected);
}

TEST(Validator, FindsAParentThatIsNotOneLevelAbove) {
  for (const Index parent : {Index{3}, Index{20}, Index{21}, Index{22}, kNone}) {
    Hierarchy h = kSound;
    h.parent[5] = parent;
    EXPECT_EQ(found(h), "parent-one-above is broken at level 0, node 5") << parent;
  }
  Hierarchy h = kSound;
  h.parent[18] = 17;
  EXPECT_EQ(found(h), "parent-one-above is broken at level 1, node 18");
}

TEST(Validator, FindsAParentOfTheTop) {
  Hierarchy h = kSound;
  h.parent[21] = 20;
  EXPECT_EQ(found(h), "top-has-no-parent is broken at level 2, node 21");
  Hierarchy single{{0, 16}, std::vector<Index>(16, kNone)};
  single.parent[3] = 4;
  EXPECT_EQ(found(single), "top-has-no-parent is broken at level 0, node 3");
}

TEST(Validator, FindsAnEmptyCluster) {
  Hierarchy h = test::drawn(kRows);
  for (Index v = 0; v < 16; ++v)
    if (h.parent[v] == 18) h.parent[v] = 16;
  EXPECT_EQ(found(h), "cluster-not-empty is broken at level 1, node 18");
}

TEST(Validator, FindsAClusterThatHasFallenApart) {
  Hierarchy h = test::drawn(kRows);
  apply(h, {15, 16});
  EXPECT_EQ(found(h), "cluster-connected is broken at level 1, node 16");
}

TEST(Validator, FindsAClusterThatHasFallenApartOnACoarserLevelOnly) {
  // a and d meet across the diagonal, b and c do not.
  EXPECT_EQ(found(kSound), "cluster-connected is broken at level 2, node 21");
  EXPECT_EQ(found(test::drawn(kRows, "xyzx")), "nothing");
}

TEST(Validator, FindsALostTriangleAndTwoSheetsThatTouch) {
  // b and c meet around a: their nodes touch twice.
  const Mesh mesh = test::sheet(5, 5).mesh;
  const Hierarchy h = test::drawn({"bbbbb", "caabb", "cabbb", "cccdd", "cccdd"});
  EXPECT_EQ(found(h, mesh), "nothing");
  EXPECT_EQ(found(h, mesh, Topology::kPreserve).substr(0, 34), "manifold-kept is broken at level 1");
}

TEST(Validator, FindsAHandleThatIsGone) {
  const Shape ring = test::torus(4, 8);
  // A cluster for each two circles of the tube: rings, which are no discs.
  Hierarchy h{{0, 32, 36}, std::vector<Index>(36, kNone)};
  for (Index v = 0; v < 32; ++v) h.parent[v] = 32 + v / 8;
  EXPECT_EQ(found(h, ring.mesh), "nothing");
  EXPECT_EQ(found(h, ring.mesh, Topology::kPreserve).substr(0, 34), "manifold-kept is broken at level 1");
}

TEST(Validator, FindsAHoleThatHasClosed) {
  const Shape annulus = test::sheet(4, 4, [](Index x, Index y) { return x != 1 || y != 1; });
  Hierarchy h = test::drawn({"abcd", "eooh", "iool", "mnpq"});  // all around the hole is one cluster
  EXPECT_EQ(found(h, annulus.mesh), "nothing");
  EXPECT_EQ(found(h, annulus.mesh, Topology::kPreserve).substr(0, 34), "manifold-kept is broken at level 1");
}

TEST(Validator, FindsAComponentThatHasVanished) {
  const Shape two = test::together(test::sheet(4, 4), test::octahedron(), 8);
  Hierarchy h = test::drawn(kRows);
  Hierarchy with{{0, 22, 27}, {}};
  for (Index v = 0; v < 16; ++v) with.parent.push_back(h.parent[v] + 6);
  for (Index v = 0; v < 6; ++v) with.parent.push_back(26);
  with.parent.resize(27, kNone);
  EXPECT_EQ(found(with, two.mesh), "nothing");
  EXPECT_EQ(found(with, two.mesh, Topology::kPreserve), "manifold-kept is broken at level 1, node 26");
}

TEST(Validator, PromisesNoShapeOfWhatWasNoManifold) {
  // Two triangles of three share their edge with a third one: any clusters will do as long as they hold together.
  const Mesh fins{6, {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}}};
  const Hierarchy h{{0, 6, 8}, {6, 6, 6, 6, 6, 7, kNone, kNone}};
  EXPECT_EQ(found(h, fins, Topology::kPreserve), "nothing");
}

TEST(Validator, KeepsNothingOfTheHierarchyBefore) {
  Validator validator(kMesh, Topology::kPreserve);
  const Hierarchy sound = test::drawn(kRows);
  Hierarchy broken = sound;
  apply(broken, {15, 16});
  for (int i = 0; i < 3; ++i) {
    EXPECT_FALSE(validator(sound));
    EXPECT_TRUE(validator(broken));
  }
}

}  // namespace
}  // namespace limber
