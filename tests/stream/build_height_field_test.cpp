// SPDX-License-Identifier: Apache-2.0
#include "limber/stream/build_height_field.h"

#include <cmath>
#include <gtest/gtest.h>

#include "limber/stream/four_k_parts.h"
#include "tests/stream/four_k_files.h"
#include "tests/support/topology.h"

namespace limber {
namespace {

// Waves over a grid, which are higher to the right.
HeightField waves(Index width, Index depth) {
  HeightField field{.width = width, .depth = depth, .lowest = -8, .highest = 8, .read = {}};
  field.read = [width](Index row, Index column, std::span<float> heights) {
    for (std::size_t i = 0; i < heights.size(); ++i) {
      const auto x = static_cast<float>(column + i), z = static_cast<float>(row);
      heights[i] = 1.2f * std::sin(x * 0.3f) * std::cos(z * 0.2f) * x / static_cast<float>(width);
    }
    return Result<void>();
  };
  return field;
}

// One sheet without a hole.
void expect_conforming(const PartsMesh& mesh) {
  const test::Invariants found = test::invariants_of(mesh.triangles);
  EXPECT_TRUE(found.is_manifold && found.is_oriented);
  EXPECT_EQ(found.euler_characteristic, 1);
  EXPECT_EQ(found.border_loop_count, 1);
  EXPECT_EQ(found.component_count, 1);
}

class BuildHeightField : public testing::Test {
 protected:
  BuildHeightField() {
    const auto made = build_height_field(waves(70, 50), {.tile = 16, .tile_share = 0.1}, test::into(bytes_));
    EXPECT_TRUE(made);
    if (made) report_ = *made;
    EXPECT_TRUE(decoder_.open(bytes_));
  }

  PartsMesh mesh_of_size(std::uint64_t most, FrontBudget unit) {
    const auto error = error_for_size(decoder_, most, unit);
    EXPECT_TRUE(error);
    auto mesh = mesh_at_error(decoder_, error ? *error : 0);
    EXPECT_TRUE(mesh);
    return mesh ? std::move(*mesh) : PartsMesh();
  }

  std::vector<std::byte> bytes_;
  HeightFieldReport report_;
  FourKDecoder decoder_;
};

TEST_F(BuildHeightField, WritesATileAPartAndWhatJoinsThemFirst) {
  EXPECT_EQ(report_.tile_count, 5u * 4u);
  EXPECT_EQ(decoder_.part_count(), 21u);
  EXPECT_TRUE(decoder_.is_whole());
  EXPECT_EQ(report_.finest_count, 2u * 69 * 49);
  const auto first = decoder_.read_part(0);
  ASSERT_TRUE(first);
  EXPECT_EQ(first->mesh.finest_count, report_.seam_count);
  for (std::uint32_t p = 0; p < decoder_.part_count(); ++p) {
    const auto part = decoder_.read_part(p);
    ASSERT_TRUE(part);
    EXPECT_EQ(validate(part->mesh, part->positions), nullptr) << p;
  }
}

TEST_F(BuildHeightField, GivesAConformingMeshAtEveryError) {
  std::size_t before = ~std::size_t{0};
  for (const float error : {0.0f, 0.001f, 0.003f, 0.01f, 0.03f, 0.1f, 0.3f, 1.0f, 3.0f}) {
    const auto mesh = mesh_at_error(decoder_, error);
    ASSERT_TRUE(mesh);
    SCOPED_TRACE(error);
    expect_conforming(*mesh);
    EXPECT_LE(mesh->triangles.size(), before);
    before = mesh->triangles.size();
    for (const auto& [a, b, c] : mesh->triangles) {
      const Vec3f p = mesh->positions[a];
      ASSERT_GT(cross(mesh->positions[b] - p, mesh->positions[c] - p).y, 0) << error;
    }
  }
  EXPECT_LT(before, 100u);
}

TEST_F(BuildHeightField, GivesAConformingMeshForEveryBallAndViewpoint) {
  for (int i = 0; i < 24; ++i) {
    FrontRequest request{.error = i % 3 == 0 ? 0.02 : 0.3};
    const double x = 3 * i, z = 48 - 2 * i;
    if (i % 2 == 0) request.focus = Ball{{x, 0, z}, 1.0 + i};
    if (i % 2 == 1) request.view = Viewpoint{.eye = {x, 5, z}, .target = {35, 0, 25}};
    if (i % 4 == 1) request.pixels = 4, request.error.reset();
    const auto mesh = mesh_for_request(decoder_, request);
    ASSERT_TRUE(mesh);
    SCOPED_TRACE(i);
    expect_conforming(*mesh);
  }
}

TEST_F(BuildHeightField, IsTheFinestInsideABall) {
  const Vec3d center{40, 0, 30};
  const auto mesh = mesh_for_request(decoder_, {.focus = Ball{center, 8}});
  ASSERT_TRUE(mesh);
  EXPECT_LT(mesh->triangles.size(), report_.finest_count / 2);
  std::size_t inside = 0;
  for (const Vec3f& p : mesh->positions) inside += length(static_cast<Vec3d>(p) - center) < 7;
  std::size_t all = 0;
  const auto finest = mesh_at_error(decoder_, -1);
  for (const Vec3f& p : finest->positions) all += length(static_cast<Vec3d>(p) - center) < 7;
  EXPECT_EQ(inside, all);
}

TEST_F(BuildHeightField, FindsTheErrorForANumberOfVertices) {
  for (const std::uint64_t most : {2000u, 300u, 40u}) {
    const std::size_t count = mesh_of_size(most, FrontBudget::kVertices).positions.size();
    EXPECT_LE(count, most);
    EXPECT_GT(count, most / 2);
  }
}

TEST_F(BuildHeightField, JoinsItsPartsSoundly) {
  const auto wrong = validate_joints(decoder_);
  ASSERT_TRUE(wrong);
  EXPECT_EQ(*wrong, std::nullopt);
}

TEST_F(BuildHeightField, IsTheWholeFieldWithoutAnError) {
  const auto mesh = mesh_at_error(decoder_, -1);
  ASSERT_TRUE(mesh);
  EXPECT_EQ(mesh->triangles.size(), report_.finest_count);
  ASSERT_EQ(mesh->numbers.size(), 70u * 50u);
  for (Index v = 0; v < mesh->numbers.size(); ++v) {
    EXPECT_EQ(mesh->numbers[v], v);
    EXPECT_NEAR(mesh->positions[v].x, v % 70, 0.01);
    EXPECT_NEAR(mesh->positions[v].z, v / 70, 0.01);
  }
}

TEST_F(BuildHeightField, FindsTheErrorForANumberOfTriangles) {
  for (const std::uint64_t most : {5000u, 1000u, 300u, 50u}) {
    const std::size_t count = mesh_of_size(most, FrontBudget::kTriangles).triangles.size();
    EXPECT_LE(count, most);
    EXPECT_GT(count, most / 2);
  }
}

TEST_F(BuildHeightField, StopsWhenItIsAskedTo) {
  std::vector<std::byte> bytes;
  const auto made =
      build_height_field(waves(70, 50), {.tile = 16}, test::into(bytes), [](std::uint32_t) { return false; });
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().code, ErrorCode::kCancelled);
}

}  // namespace
}  // namespace limber
