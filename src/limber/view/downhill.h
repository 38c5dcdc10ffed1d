// SPDX-License-Identifier: Apache-2.0
// A triangle of the finest surface that is near a point, by steps that only ever come nearer.
// Part of the player: standard library only.
#pragma once

#include <limits>
#include <span>

#include "limber/base/mesh.h"
#include "limber/base/vec.h"
#include "limber/view/stars.h"
#include "limber/view/triangle_distance.h"

namespace limber {

struct NearFace {
  Index face = kNone;  // of the finest mesh
  float square = std::numeric_limits<float>::infinity();
};

inline float squared_distance_to_face(const Mesh& mesh, std::span<const Vec3f> positions, const Vec3f& point,
                                      Index face) {
  const auto& [a, b, c] = mesh.triangles[face];
  return squared_distance_to_triangle(point, positions[a], positions[b], positions[c]);
}

// From the triangles around the vertex to those around their corners, as long as one is nearer and none near enough.
inline NearFace walk_downhill(const Mesh& mesh, const Stars& stars, std::span<const Vec3f> positions,
                              const Vec3f& point, Index start, float enough) {
  constexpr int kSteps = 32;
  NearFace near;
  const auto try_star = [&](Index vertex) {
    bool better = false;
    for (const Index face : stars.of(vertex)) {
      const float square = squared_distance_to_face(mesh, positions, point, face);
      if (!(square < near.square)) continue;
      near = {face, square};
      better = true;
    }
    return better;
  };
  bool better = try_star(start);
  Triangle tried{start, start, start};  // there is nothing nearer around these
  for (int step = 0; step < kSteps && better && near.square > enough; ++step) {
    better = false;
    const Triangle around = mesh.triangles[near.face];
    for (const Index corner : around) {
      if (corner != tried[0] && corner != tried[1] && corner != tried[2]) better |= try_star(corner);
    }
    tried = around;
  }
  return near;
}

}  // namespace limber
