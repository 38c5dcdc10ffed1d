// SPDX-License-Identifier: Apache-2.0
// Triangles cut into smaller ones of the same surface, so that values can be shown inside of them.
#pragma once

#include <vector>

#include "eval/surface.h"

namespace limber::eval {

struct Subdivided {
  std::vector<Triangle> triangles;
  std::vector<Vec3f> positions;
  std::vector<Vec3f> normals;  // [positions.size()], interpolated

  operator Surface() const { return {triangles, positions}; }
};

// Each triangle in steps * steps, steps >= 1. Vertices are shared inside a triangle but not across its border: every
// edge of the original triangles is a border of the result. normals: [surface.positions.size()].
Subdivided subdivide(const Surface& surface, std::span<const Vec3f> normals, Index steps);

}  // namespace limber::eval
