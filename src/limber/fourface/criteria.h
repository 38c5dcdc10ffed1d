// SPDX-License-Identifier: Apache-2.0
// What a front can be moved by, beside the error itself: values of operations, monotone as Front wants them, because
// the spheres of operations hold those of the operations that they depend on.
#pragma once

#include <cmath>
#include <limits>
#include <span>

#include "limber/base/vec.h"
#include "limber/fourface/four_k_mesh.h"

namespace limber {

// A half-space: where dot(normal, p) >= offset. `normal` has unit length.
struct HalfSpace {
  Vec3d normal;
  double offset = 0;
};

// The distance from the point to the operation's sphere, 0 inside.
inline double distance_to(const FourKMesh& mesh, std::span<const Vec3f> positions, Index operation,
                          const Vec3d& point) {
  const double apart = length(static_cast<Vec3d>(positions[mesh.vertex[operation]]) - point);
  return std::fmax(apart - static_cast<double>(mesh.radius[operation]), 0);
}

// The error as it is seen from `eye`: error over distance, infinite where the eye is inside the sphere; 0 where the
// sphere lies outside one of the half-spaces of what is seen.
inline double seen_error(const FourKMesh& mesh, std::span<const Vec3f> positions, Index operation, const Vec3d& eye,
                         std::span<const HalfSpace> seen) {
  const auto center = static_cast<Vec3d>(positions[mesh.vertex[operation]]);
  for (const HalfSpace& half : seen)
    if (dot(half.normal, center) + static_cast<double>(mesh.radius[operation]) < half.offset) return 0;
  const double distance = distance_to(mesh, positions, operation, eye);
  const auto error = static_cast<double>(mesh.error[operation]);
  if (error == 0) return 0;
  return distance > 0 ? error / distance : std::numeric_limits<double>::infinity();
}

// The error inside the ball around `center`; 0 where the operation's sphere does not reach it.
inline double error_in_ball(const FourKMesh& mesh, std::span<const Vec3f> positions, Index operation,
                            const Vec3d& center, double radius) {
  return distance_to(mesh, positions, operation, center) <= radius ? static_cast<double>(mesh.error[operation]) : 0;
}

}  // namespace limber
