// SPDX-License-Identifier: Apache-2.0
// Four-face files in memory.
#pragma once

#include <algorithm>
#include <gtest/gtest.h>
#include <utility>
#include <vector>

#include "limber/contract/bounds.h"
#include "limber/fourface/build_four_k.h"
#include "limber/fourface/frame_errors.h"
#include "limber/stream/four_k_encoder.h"
#include "tests/support/shapes.h"

namespace limber::test {

inline ByteSink into(std::vector<std::byte>& bytes) {
  return [&bytes](std::span<const std::byte> more) {
    bytes.insert(bytes.end(), more.begin(), more.end());
    return Result<void>();
  };
}

// One part, and frames that sway to and fro.
inline std::vector<std::byte> four_k_file(const Shape& shape, FourKEncoderOptions options = {}) {
  std::vector<std::byte> bytes;
  FourKEncoder encoder(into(bytes));
  FourKMesh mesh = build_four_k(shape.mesh, shape.positions, {});
  EXPECT_TRUE(encoder.begin(bounds(shape.positions), shape.mesh.vertex_count, options));
  const auto added = encoder.add_part(mesh, shape.positions);
  EXPECT_TRUE(added) << (added ? "" : added.error().line());
  for (std::uint32_t frame = 1; frame < options.frame_count; ++frame) {
    std::vector<Vec3f> positions = shape.positions;
    for (Vec3f& p : positions) p.z += 0.1f * static_cast<float>(frame % 4) * p.x;
    measure_frame(mesh, positions);
    EXPECT_TRUE(encoder.add_frame(positions, mesh.error));
  }
  EXPECT_TRUE(encoder.finish());
  return bytes;
}

// Triangles in a form that does not depend on rotation and order, their corners mapped.
inline std::vector<Triangle> sorted_triangles(std::vector<Triangle> triangles, std::span<const Index> numbers = {}) {
  for (Triangle& t : triangles) {
    if (!numbers.empty())
      for (Index& corner : t) corner = numbers[corner];
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

}  // namespace limber::test
