// SPDX-License-Identifier: Apache-2.0
#include "eval/ground.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "eval/finite.h"

namespace limber::eval {
namespace {

constexpr float kSkyShare = 0.80f, kKeyShare = 0.18f;  // of the darkness

// 1 inside, falling smoothly to 0 at the circle inside a square of side 1.
float fade_to_border(double u, double v) {
  const double radius = 2.0 * std::sqrt((u - 0.5) * (u - 0.5) + (v - 0.5) * (v - 0.5));
  const double t = std::clamp((1.0 - radius) / 0.45, 0.0, 1.0);
  return static_cast<float>(t * t * (3.0 - 2.0 * t));
}

// A light from few directions leaves a pattern where the mesh is far from the ground. Dark places, which are near the
// mesh, keep their edges; faint ones are smoothed over more texels.
void blur(std::vector<float>& values, int size) {
  for (const int radius : {1, 2, 3, 4}) {
    for (const bool rows : {true, false}) {
      const std::vector<float> before = values;
      const std::size_t step = rows ? 1 : static_cast<std::size_t>(size);
      for (int j = 0; j < size; ++j) {
        for (int i = 0; i < size; ++i) {
          const std::size_t k =
              static_cast<std::size_t>(j) * static_cast<std::size_t>(size) + static_cast<std::size_t>(i);
          const int place = rows ? i : j;
          const int reach = std::min({radius, place, size - 1 - place});
          float sum = before[k];
          for (int d = 1; d <= reach; ++d)
            sum += before[k - static_cast<std::size_t>(d) * step] + before[k + static_cast<std::size_t>(d) * step];
          const float smooth = sum / static_cast<float>(2 * reach + 1);
          const float keep = std::clamp((before[k] - 0.42f) * 5.0f, 0.0f, 1.0f);
          values[k] = before[k] * keep + smooth * (1.0f - keep);
        }
      }
    }
  }
}

}  // namespace

GroundShadow::GroundShadow(std::span<const Triangle> triangles, std::span<const Vec3f> positions, const Vec3f& up,
                           double height)
    : up_(up), height_(height), darkness_(static_cast<std::size_t>(kSize) * kSize, 0.0f) {
  const Vec3d axis = std::fabs(up_.x) < 0.6 ? Vec3d{1.0, 0.0, 0.0} : Vec3d{0.0, 1.0, 0.0};
  across_ = cross(axis, up_);
  across_ *= 1.0 / length(across_);
  along_ = cross(up_, across_);
  Box box;  // across, along, and height over the ground
  for (const Triangle& t : triangles) {
    if (!has_finite_corners(t, positions)) continue;
    for (const Index corner : t) {
      const Vec3d p(positions[corner]);
      box.add({dot(p, across_), dot(p, along_), dot(p, up_) - height_});
    }
  }
  if (box.empty()) return;
  const double extent = std::max(box.high.x - box.low.x, box.high.y - box.low.y);
  const double side = 1.75 * extent + 1.2 * std::max(box.high.z, 0.0);
  if (!(side > 0.0)) return;
  texel_ = side / kSize;
  low_u_ = box.center().x - 0.5 * side;
  low_v_ = box.center().y - 0.5 * side;
}

std::vector<Receiver> GroundShadow::receivers() const {
  std::vector<Receiver> receivers;
  receivers.reserve(darkness_.size());
  const Vec3f up(up_);
  for (int j = 0; j < kSize; ++j) {
    for (int i = 0; i < kSize; ++i) {
      const Vec3d p = across_ * (low_u_ + (i + 0.5) * texel_) + along_ * (low_v_ + (j + 0.5) * texel_) + up_ * height_;
      receivers.push_back({Vec3f(p), up, up});
    }
  }
  return receivers;
}

void GroundShadow::set_reached(std::span<const Reached> reached) {
  assert(reached.size() == darkness_.size());
  for (std::size_t k = 0; k < reached.size(); ++k) {
    darkness_[k] = kSkyShare * (1.0f - reached[k].sky) + kKeyShare * (1.0f - reached[k].key);
  }
  blur(darkness_, kSize);
  for (int j = 0; j < kSize; ++j) {
    for (int i = 0; i < kSize; ++i) {
      darkness_[static_cast<std::size_t>(j) * kSize + static_cast<std::size_t>(i)] *=
          fade_to_border((i + 0.5) / kSize, (j + 0.5) / kSize);
    }
  }
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
