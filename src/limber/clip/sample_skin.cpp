// SPDX-License-Identifier: Apache-2.0
#include "limber/clip/sample_skin.h"

#include <algorithm>
#include <cassert>

#include "limber/base/portable_math.h"

namespace limber {

Matrix3 rotation_between(const Vec3d& from, const Vec3d& to) {
  // Rodrigues' formula with the sine in the length of the axis.
  const Vec3d v = cross(from, to);
  const double c = dot(from, to), k = 1.0 / (1.0 + c);
  assert(c > -0.999999);
  Matrix3 m;
  m.rows[0] = {c + k * v.x * v.x, k * v.x * v.y - v.z, k * v.x * v.z + v.y};
  m.rows[1] = {k * v.x * v.y + v.z, c + k * v.y * v.y, k * v.y * v.z - v.x};
  m.rows[2] = {k * v.x * v.z - v.y, k * v.y * v.z + v.x, c + k * v.z * v.z};
  return m;
}

SkinWeights skin_weights(const Body& body, std::span<const Vec3d> positions, double softness) {
  constexpr double kLeast = 0.002;  // weights below this part of the greatest are left out, without a jump
  assert(body.limb_count() <= 256);
  SkinWeights skin;
  skin.first.push_back(0);
  std::vector<double> distances(body.limb_count());
  for (const Vec3d& p : positions) {
    for (std::size_t i = 0; i < distances.size(); ++i) distances[i] = body.distance_to_limb(i, p);
    const double nearest = *std::min_element(distances.begin(), distances.end());
    const std::size_t begin = skin.weights.size();
    double sum = 0.0;
    for (std::size_t i = 0; i < distances.size(); ++i) {
      const double weight = portable_exp((nearest - distances[i]) / softness) - kLeast;
      if (weight <= 0.0) continue;
      skin.limbs.push_back(static_cast<std::uint8_t>(i));
      skin.weights.push_back(static_cast<float>(weight));
      sum += weight;
    }
    for (std::size_t i = begin; i < skin.weights.size(); ++i) {
      skin.weights[i] = static_cast<float>(static_cast<double>(skin.weights[i]) / sum);
    }
    skin.first.push_back(static_cast<Index>(skin.weights.size()));
  }
  return skin;
}

}  // namespace limber
