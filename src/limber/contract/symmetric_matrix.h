// SPDX-License-Identifier: Apache-2.0
// Symmetric 3 x 3 matrices: quadratic forms x'Ax.
#pragma once

#include "limber/base/vec.h"

namespace limber {

struct SymmetricMatrix {
  double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;

  // Adds weight x (v.x)^2.
  void add_along(const Vec3d& v, double weight) {
    const Vec3d w = v * weight;
    xx += w.x * v.x, xy += w.x * v.y, xz += w.x * v.z, yy += w.y * v.y, yz += w.y * v.z, zz += w.z * v.z;
  }
  // Adds weight x |v cross x|^2.
  void add_across(const Vec3d& v, double weight) {
    add_along(v, -weight);
    add_diagonal(weight * squared_length(v));
  }
  // Adds weight x |x|^2.
  void add_diagonal(double weight) { xx += weight, yy += weight, zz += weight; }

  SymmetricMatrix& operator+=(const SymmetricMatrix& o) {
    xx += o.xx, xy += o.xy, xz += o.xz, yy += o.yy, yz += o.yz, zz += o.zz;
    return *this;
  }
  SymmetricMatrix& operator-=(const SymmetricMatrix& o) {
    xx -= o.xx, xy -= o.xy, xz -= o.xz, yy -= o.yy, yz -= o.yz, zz -= o.zz;
    return *this;
  }
  friend SymmetricMatrix operator+(SymmetricMatrix a, const SymmetricMatrix& b) { return a += b; }
  friend SymmetricMatrix operator-(SymmetricMatrix a, const SymmetricMatrix& b) { return a -= b; }
  friend Vec3d operator*(const SymmetricMatrix& a, const Vec3d& v) {
    return {a.xx * v.x + a.xy * v.y + a.xz * v.z, a.xy * v.x + a.yy * v.y + a.yz * v.z,
            a.xz * v.x + a.yz * v.y + a.zz * v.z};
  }

  double trace() const { return xx + yy + zz; }
};

// Solves A x = b for a positive definite A, by an LDL' factorisation. For another A the answer means nothing; for 0 it
// is 0.
inline Vec3d solve(const SymmetricMatrix& a, const Vec3d& b) {
  const auto inverse = [](double pivot) { return pivot > 1e-300 ? 1 / pivot : 0.0; };
  const double i0 = inverse(a.xx);
  const double l10 = a.xy * i0, l20 = a.xz * i0;
  const double i1 = inverse(a.yy - l10 * a.xy);
  const double m21 = a.yz - l20 * a.xy, l21 = m21 * i1;
  const double i2 = inverse(a.zz - l20 * a.xz - l21 * m21);
  const double y1 = b.y - l10 * b.x, y2 = b.z - l20 * b.x - l21 * y1;
  const double z = y2 * i2, y = y1 * i1 - l21 * z;
  return {b.x * i0 - l10 * y - l20 * z, y, z};
}

}  // namespace limber
