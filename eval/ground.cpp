// SPDX-License-Identifier: Apache-2.0
#include "eval/ground.h"

#include <algorithm>
#include <cmath>

namespace limber::eval {
namespace {

// 1 inside, falling smoothly to 0 at the borders of a square of side 1.
float fade_to_border(double u, double v) {
  const double distance = std::min({u, v, 1.0 - u, 1.0 - v});
  const double t = std::clamp(distance / 0.18, 0.0, 1.0);
  return static_cast<float>(t * t * (3.0 - 2.0 * t));
}

}  // namespace

GroundShadow::GroundShadow(std::span<const Triangle> triangles, std::span<const Vec3f> positions, const Studio& studio,
                           double height)
    : up_(studio.up), height_(height), darkness_(static_cast<std::size_t>(kSize) * kSize, 0.0f) {
  const Vec3d axis = std::fabs(up_.x) < 0.6 ? Vec3d{1.0, 0.0, 0.0} : Vec3d{0.0, 1.0, 0.0};
  across_ = cross(axis, up_);
  across_ *= 1.0 / length(across_);
  along_ = cross(up_, across_);
  Box box;  // across, along, and height over the ground
  for (const Vec3f& q : positions) {
    const Vec3d p(q);
    if (is_finite(p)) box.add({dot(p, across_), dot(p, along_), dot(p, up_) - height_});
  }
  if (box.empty()) return;
  const double reach =
      0.55 * std::max(box.high.z, 0.0) + 0.25 * std::max(box.high.x - box.low.x, box.high.y - box.low.y);
  const double side = std::max(box.high.x - box.low.x, box.high.y - box.low.y) + 2.0 * reach;
  if (!(side > 0.0)) return;
  texel_ = side / kSize;
  low_u_ = box.center().x - 0.5 * side;
  low_v_ = box.center().y - 0.5 * side;

  std::vector<Receiver> receivers;
  receivers.reserve(darkness_.size());
  const Vec3f up(up_);
  for (int j = 0; j < kSize; ++j) {
    for (int i = 0; i < kSize; ++i) {
      const Vec3d p = across_ * (low_u_ + (i + 0.5) * texel_) + along_ * (low_v_ + (j + 0.5) * texel_) + up_ * height_;
      receivers.push_back({Vec3f(p), up, up});
    }
  }
  const std::vector<Reached> reached = reached_light(triangles, positions, studio.lights, receivers);
  for (int j = 0; j < kSize; ++j) {
    for (int i = 0; i < kSize; ++i) {
      const std::size_t k = static_cast<std::size_t>(j) * kSize + static_cast<std::size_t>(i);
      const float missing = 0.72f * (1.0f - reached[k].sky) + 0.20f * (1.0f - reached[k].key);
      darkness_[k] = missing * fade_to_border((i + 0.5) / kSize, (j + 0.5) / kSize);
    }
  }
}

float GroundShadow::inverse_depth(const Vec3d& eye, const Vec3d& ray) const {
  const double above = dot(eye, up_) - height_, falling = -dot(ray, up_);
  return above > 0.0 && falling > 0.0 ? static_cast<float>(falling / above) : 0.0f;
}

float GroundShadow::darkness(const Vec3d& eye, const Vec3d& ray) const {
  const double above = dot(eye, up_) - height_, falling = -dot(ray, up_);
  if (!(above > 0.0 && falling > 0.0)) return 0.0f;
  const Vec3d p = eye + ray * (above / falling);
  const double u = (dot(p, across_) - low_u_) / texel_ - 0.5, v = (dot(p, along_) - low_v_) / texel_ - 0.5;
  if (!(u >= 0.0 && v >= 0.0 && u < kSize - 1 && v < kSize - 1)) return 0.0f;
  const auto i = static_cast<std::size_t>(u), j = static_cast<std::size_t>(v);
  const float fu = static_cast<float>(u - static_cast<double>(i)), fv = static_cast<float>(v - static_cast<double>(j));
  const float* t = darkness_.data() + j * kSize + i;
  return (t[0] * (1.0f - fu) + t[1] * fu) * (1.0f - fv) + (t[kSize] * (1.0f - fu) + t[kSize + 1] * fu) * fv;
}

}  // namespace limber::eval
