// SPDX-License-Identifier: Apache-2.0
// At the displacement d from its minimum a quadric has grown by d'Ad. Its trace is the area of the cluster, about.
//
//   M = A / (share x error + area x distance^2)
//   displacement: the minimum of  d'Md + pull |d - wanted|^2,  with less and less pull until it is within the leeway
//
// The nearest point of the ellipsoid would save more bytes, but stay on its rim in every frame; a pull costs nothing
// where the quadric gives way, and next to nothing where the wanted place is near.
#include "limber/hierarchy/leeway.h"

#include <algorithm>

namespace limber {
namespace {

constexpr double kMostPull = 0.3;  // of the trace of M
constexpr int kAttempts = 20;      // each with half the pull

}  // namespace

Leeway leeway(const Quadric& quadric, double error, double scale, const LeewayOptions& options) {
  const double area = quadric.trace();
  const double distance = options.distance * scale;
  const double growth = options.error_share * error + area * distance * distance;
  const double factor = scale * scale / std::max(growth, 1e-300);
  const auto entry = [factor](double a) { return static_cast<float>(std::clamp(a * factor, -1e30, 1e30)); };
  return {entry(quadric.xx), entry(quadric.xy), entry(quadric.xz),
          entry(quadric.yy), entry(quadric.yz), entry(quadric.zz)};
}

Vec3d displacement_towards(const Vec3d& wanted, const Leeway& m) {
  double pull = kMostPull * (double{m.xx} + m.yy + m.zz);
  for (int i = 0; i < kAttempts; ++i, pull /= 2) {
    const Vec3d force = wanted * pull;
    const Quadric pulled{m.xx + pull, m.xy, m.xz, m.yy + pull, m.yz, m.zz + pull, -force.x, -force.y, -force.z, 0};
    const Vec3d d = minimum(pulled).point;
    if (m(d) <= 1) return d;
  }
  return {};
}

}  // namespace limber
