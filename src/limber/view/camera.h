// SPDX-License-Identifier: Apache-2.0
// Where something is seen from.
// Part of the player: standard library only.
#pragma once

#include "limber/base/vec.h"

namespace limber {

// A perspective camera. It knows no picture size, so one camera serves all frames of a clip, all levels and all sizes.
struct Camera {
  Vec3d eye{0.0, 0.0, 5.0};
  Vec3d target{};
  Vec3d up{0.0, 1.0, 0.0};    // the world's up: what stands upright, and the normal of the ground
  double fov_degrees = 24.0;  // vertical field of view, in (0, 120]

  friend bool operator==(const Camera&, const Camera&) = default;
};

// Orthonormal and right-handed: right and up in the picture, back from the target to the eye.
struct CameraAxes {
  Vec3d right, up, back;
};

// Where a direction has no length, or `up` is parallel to it, others stand in.
CameraAxes camera_axes(const Vec3d& towards_eye, const Vec3d& up);
inline CameraAxes camera_axes(const Camera& camera) { return camera_axes(camera.eye - camera.target, camera.up); }

// The tangent of half the angle, which is clamped to 0.01 to 120 degrees. The same on every machine.
double tangent_of_half(double degrees);

}  // namespace limber
