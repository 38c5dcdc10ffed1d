// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "limber/fourface/build_four_k.h"
#include "limber/fourface/four_k_mesh.h"
#include "tests/support/shapes.h"

namespace limber {
namespace {

class ValidateFourK : public testing::Test {
 protected:
  const char* broken() const { return validate(mesh_, shape_.positions); }
  // The first operation that destroys what another has created.
  Index dependent() const {
    for (Index o = 0; o < mesh_.operation_count(); ++o)
      for (const Index t : mesh_.destroyed_by(o))
        if (mesh_.creator[t] != kNone) return o;
    return kNone;
  }

  test::Shape shape_ = test::waved(test::sheet(12, 12));
  FourKMesh mesh_ = build_four_k(shape_.mesh, shape_.positions, {});
};

TEST_F(ValidateFourK, FindsNothingInWhatWasBuilt) { EXPECT_EQ(broken(), nullptr); }

TEST_F(ValidateFourK, FindsArraysOfDifferentLengths) {
  mesh_.radius.pop_back();
  EXPECT_STREQ(broken(), "operations-numbered");
}

TEST_F(ValidateFourK, FindsACornerThatIsNoVertex) {
  mesh_.triangles.back()[1] = mesh_.vertex_count;
  EXPECT_STREQ(broken(), "operations-numbered");
}

TEST_F(ValidateFourK, FindsATriangleThatIsDestroyedTwice) {
  mesh_.destroyed[mesh_.destroyed_begin[1]] = mesh_.destroyed[0];
  EXPECT_STREQ(broken(), "triangle-created-once");
}

TEST_F(ValidateFourK, FindsACreatorThatIsNot) {
  mesh_.creator.back() = 0;
  EXPECT_STREQ(broken(), "triangle-created-once");
}

TEST_F(ValidateFourK, FindsAnOperationThatLeavesAHole) {
  Triangle& t = mesh_.triangles[mesh_.created_begin[0]];
  std::swap(t[0], t[1]);
  EXPECT_STREQ(broken(), "operation-local");
}

TEST_F(ValidateFourK, FindsAVertexThatIsNotRemoved) {
  mesh_.vertex[0] = mesh_.vertex[0] == 0 ? 1 : 0;
  EXPECT_STREQ(broken(), "operation-local");
}

TEST_F(ValidateFourK, FindsAnErrorBelowThatOfWhatItDependsOn) {
  const Index o = dependent();
  mesh_.error[o] = -1;
  EXPECT_STREQ(broken(), "errors-monotone");
}

TEST_F(ValidateFourK, FindsASphereThatIsTooSmall) {
  mesh_.radius[dependent()] *= 0.9f;
  EXPECT_STREQ(broken(), "spheres-nested");
}

// A pillow of two triangles with an inner vertex on each side: removing both would give two edges twice.
TEST(ValidateFourKEdges, FindsAnEdgeThatIsThereAlready) {
  FourKMesh mesh;
  mesh.vertex_count = 6;
  mesh.finest_count = 5;
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}, {3, 1, 5}, {1, 2, 3}, {1, 3, 4}};
  mesh.creator = {kNone, kNone, kNone, kNone, kNone, 0, 0};
  mesh.destroyer = {0, 0, 0, 0, kNone, kNone, kNone};
  mesh.created_begin = {5, 7};
  mesh.destroyed_begin = {0, 4};
  mesh.destroyed = {0, 1, 2, 3};
  mesh.vertex = {0};
  mesh.error = {0};
  mesh.radius = {9};
  mesh.level_begin = {0, 1};
  const std::vector<Vec3f> positions(6);
  EXPECT_STREQ(validate(mesh, positions), "edge-created-once");
}

}  // namespace
}  // namespace limber
