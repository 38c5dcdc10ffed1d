// SPDX-License-Identifier: Apache-2.0
#include "limber/stream/mesh_coding.h"

#include <gtest/gtest.h>
#include <random>

#include "tests/stream/sample_clip.h"

namespace limber {
namespace {

std::vector<std::byte> written(const Mesh& mesh) {
  RangeEncoder coder;
  MeshCoding<RangeEncoder> coding(coder, mesh.vertex_count, mesh.triangles.size());
  for (Triangle triangle : mesh.triangles) EXPECT_TRUE(coding.code(triangle));
  return coder.finish();
}

Mesh read_back(std::span<const std::byte> bytes, Index vertex_count, std::size_t triangle_count) {
  Mesh mesh{vertex_count, std::vector<Triangle>(triangle_count)};
  RangeDecoder coder(bytes);
  MeshCoding<RangeDecoder> coding(coder, vertex_count, triangle_count);
  for (Triangle& triangle : mesh.triangles) EXPECT_TRUE(coding.code(triangle));
  return mesh;
}

void expect_unchanged(const Mesh& mesh) {
  EXPECT_EQ(read_back(written(mesh), mesh.vertex_count, mesh.triangles.size()), mesh);
}

TEST(MeshCoding, KeepsOrderRotationAndNumbersOfARoughMesh) { expect_unchanged(test::rough_mesh()); }

TEST(MeshCoding, KeepsTrianglesWithoutAnyOrder) {
  std::mt19937 random(1);
  Mesh mesh{1000, {}};
  for (int i = 0; i < 3000; ++i) {
    const auto corner = [&random] { return static_cast<Index>(random() % 1000); };
    mesh.triangles.push_back({corner(), corner(), corner()});
  }
  expect_unchanged(mesh);
}

TEST(MeshCoding, KeepsLargeNumbers) {
  expect_unchanged(Mesh{5000001, {{5000000, 0, 5000000}, {0, 5000000, 5}, {4000000, 1, 2}}});
}

TEST(MeshCoding, OfAFanTakesLinearTime) {
  Mesh fan{200000, {}};
  for (Index v = 2; v < fan.vertex_count; ++v) fan.triangles.push_back({0, 1, v});
  expect_unchanged(fan);
}

TEST(MeshCoding, OfAnOrderlyGridIsSmall) {
  const Mesh mesh = test::grid(100, 100);
  EXPECT_LT(8.0 * static_cast<double>(written(mesh).size()), 1.5 * static_cast<double>(mesh.triangles.size()));
  expect_unchanged(mesh);
}

TEST(MeshCoding, RefusesACornerBeyondTheLastVertex) {
  const auto bytes = written(Mesh{10, {{9, 8, 7}}});
  RangeDecoder coder(bytes);
  MeshCoding<RangeDecoder> coding(coder, 9, 1);
  Triangle triangle{};
  EXPECT_FALSE(coding.code(triangle));
}

}  // namespace
}  // namespace limber
