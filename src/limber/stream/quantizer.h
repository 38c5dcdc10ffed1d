// SPDX-License-Identifier: Apache-2.0
// Between coordinates and the integers that are coded. Part of the player.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "limber/base/vec.h"
#include "limber/stream/header.h"

namespace limber {

using Lattice = std::array<std::int32_t, 3>;  // a position as integers, axis by axis

// The floats in their order, -0 just below 0: neighbouring floats are neighbouring integers.
inline std::int32_t ordered_from_float(float value) {
  const auto bits = std::bit_cast<std::int32_t>(value);
  return bits >= 0 ? bits : bits ^ 0x7fffffff;
}

inline float float_from_ordered(std::int32_t ordered) {
  return std::bit_cast<float>(ordered >= 0 ? ordered : ordered ^ 0x7fffffff);
}

class Quantizer {
 public:
  Quantizer() = default;
  explicit Quantizer(const StreamHeader& header) : Quantizer(header.origin, header.step) {}
  Quantizer(const Vec3d& origin, double step) : origin_(origin), step_(step) {}

  bool lossless() const { return step_ == 0.0; }

  Vec3f position(const Lattice& at) const {
    if (lossless()) return {float_from_ordered(at[0]), float_from_ordered(at[1]), float_from_ordered(at[2])};
    return {static_cast<float>(origin_.x + step_ * at[0]), static_cast<float>(origin_.y + step_ * at[1]),
            static_cast<float>(origin_.z + step_ * at[2])};
  }

  // The nearest lattice point. Precondition: position is finite and, unless lossless, fits(position).
  Lattice lattice(const Vec3f& position) const {
    if (lossless())
      return {ordered_from_float(position.x), ordered_from_float(position.y), ordered_from_float(position.z)};
    return {nearest(position.x - origin_.x), nearest(position.y - origin_.y), nearest(position.z - origin_.z)};
  }

  // Whether the nearest lattice point is representable.
  bool fits(const Vec3f& position) const {
    const double most = 1073741824.0 * step_;
    return lossless() || (std::fabs(position.x - origin_.x) < most && std::fabs(position.y - origin_.y) < most &&
                          std::fabs(position.z - origin_.z) < most);
  }

 private:
  std::int32_t nearest(double distance) const { return static_cast<std::int32_t>(std::floor(distance / step_ + 0.5)); }

  Vec3d origin_;
  double step_ = 0.0;
};

}  // namespace limber
