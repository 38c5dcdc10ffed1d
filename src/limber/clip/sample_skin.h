// SPDX-License-Identifier: Apache-2.0
// Which parts of a body carry which vertex, and rotations.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "limber/base/mesh.h"
#include "limber/clip/sample_body.h"

namespace limber {

struct Matrix3 {
  std::array<Vec3d, 3> rows{Vec3d{1.0, 0.0, 0.0}, Vec3d{0.0, 1.0, 0.0}, Vec3d{0.0, 0.0, 1.0}};

  Vec3d operator*(const Vec3d& v) const { return {dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)}; }
};

// The shortest rotation from one unit vector to another, which is not its opposite.
Matrix3 rotation_between(const Vec3d& from, const Vec3d& to);

// The influences of vertex v are those from first[v] to first[v + 1]; their weights sum to 1.
struct SkinWeights {
  std::vector<Index> first;         // [vertex_count + 1]
  std::vector<std::uint8_t> limbs;  // [first.back()]
  std::vector<float> weights;       // likewise
};

// A limb's weight falls by e for each `softness` of distance from its surface.
SkinWeights skin_weights(const Body& body, std::span<const Vec3d> positions, double softness);

}  // namespace limber
