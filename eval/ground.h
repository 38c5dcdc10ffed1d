// SPDX-License-Identifier: Apache-2.0
// The shadow of a mesh on the ground below it.
#pragma once

#include <span>
#include <vector>

#include "eval/occlusion.h"

namespace limber::eval {

// Darkness over a square of the ground, [kSize * kSize] at texel centres, 0 at its borders.
class GroundShadow {
 public:
  // The ground is the plane of the points p with dot(p, up) = height; up is unit.
  GroundShadow(std::span<const Triangle> triangles, std::span<const Vec3f> positions, const Vec3f& up, double height);

  // The places to be measured.
  std::vector<Receiver> receivers() const;

  // reached: [receivers()]. Before this call there is no shadow.
  void set_reached(std::span<const Reached> reached);

  // Darkness in [0, 1] where a ray meets the ground before the eye; 0 where it does not. The ray need not be unit.
  float darkness(const Vec3d& eye, const Vec3d& ray) const;

 private:
  static constexpr int kSize = 256;
  Vec3d up_, across_, along_;
  double height_ = 0.0, low_u_ = 0.0, low_v_ = 0.0, texel_ = 1.0;
  std::vector<float> darkness_;
};

}  // namespace limber::eval
