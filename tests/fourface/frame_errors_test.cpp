// SPDX-License-Identifier: Apache-2.0
#include "limber/fourface/frame_errors.h"

#include <algorithm>
#include <gtest/gtest.h>

#include "limber/fourface/build_four_k.h"
#include "tests/support/shapes.h"

namespace limber {
namespace {

TEST(MeasureFrame, GivesTheErrorsThatThePoseWasBuiltWith) {
  for (const test::Shape& shape : {test::waved(test::sheet(20, 20)), test::sphere(3), test::sheet_with_hole(12, 12)}) {
    const FourKMesh built = build_four_k(shape.mesh, shape.positions, {});
    FourKMesh measured = built;
    std::fill(measured.error.begin(), measured.error.end(), -1.0f);
    measure_frame(measured, shape.positions);
    const float largest = *std::max_element(built.error.begin(), built.error.end());
    for (Index o = 0; o < built.operation_count(); ++o)
      ASSERT_NEAR(measured.error[o], built.error[o], 1e-4f * largest) << o;
    EXPECT_EQ(validate(measured, shape.positions), nullptr);
  }
}

TEST(MeasureFrame, IsMonotoneInAPoseThatTheMeshWasNotBuiltFor) {
  const test::Shape flat = test::sheet(25, 25), waved = test::waved(flat);
  FourKMesh mesh = build_four_k(flat.mesh, flat.positions, {});
  measure_frame(mesh, waved.positions);
  EXPECT_EQ(validate(mesh, waved.positions), nullptr);
  EXPECT_GT(*std::max_element(mesh.error.begin(), mesh.error.end()), 0.01f);
}

TEST(MeasureFrame, GrowsWithTheMesh) {
  test::Shape shape = test::waved(test::sheet(15, 15));
  FourKMesh mesh = build_four_k(shape.mesh, shape.positions, {});
  const FourKMesh before = mesh;
  for (Vec3f& p : shape.positions) p *= 4;
  measure_frame(mesh, shape.positions);
  for (Index o = 0; o < mesh.operation_count(); ++o) ASSERT_NEAR(mesh.error[o], 4 * before.error[o], 1e-4f) << o;
}

}  // namespace
}  // namespace limber
