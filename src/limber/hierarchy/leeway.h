// SPDX-License-Identifier: Apache-2.0
// How far a node may stand from the minimum of its quadric before anybody notices: what an encoder may use to save
// bits.
#pragma once

#include "limber/base/quadric.h"
#include "limber/base/vec.h"

namespace limber {

struct LeewayOptions {
  // By how much the quadric error of a node may grow, as a share of it, >= 0.
  double error_share = 0.02;
  // Beside that, by the square of this distance over all of the node's area, > 0; in units of the positions.
  double distance = 0;
};

// An ellipsoid around the minimum: a displacement d is within the leeway iff d'Md <= 1, M symmetric and positive
// definite. It is flat where the surface is: along it a node may move, across it hardly.
struct Leeway {
  float xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;  // M

  double operator()(const Vec3d& d) const {
    return d.x * (xx * d.x + 2 * (xy * d.y + xz * d.z)) + d.y * (yy * d.y + 2 * yz * d.z) + zz * d.z * d.z;
  }
};

// `quadric` of a cluster and `error`, its minimum, in coordinates that are `scale` times those of the positions.
Leeway leeway(const Quadric& quadric, double error, double scale, const LeewayOptions& options);

// A displacement within the leeway towards `wanted`: where the quadric resists, little of it; where not, all.
Vec3d displacement_towards(const Vec3d& wanted, const Leeway& leeway);

}  // namespace limber
