// SPDX-License-Identifier: Apache-2.0
// Quadric error functions (Garland & Heckbert 1997): Q(x) = x'Ax + 2b'x + c, a weighted sum of squared distances
// to planes and points. They add; the minimum is found by solving A x = -b.
#pragma once

#include <algorithm>

#include "limber/base/vec.h"

namespace limber {

struct Quadric {
  double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;  // A, symmetric
  double bx = 0, by = 0, bz = 0;
  double c = 0;

  // weight x squared distance to the plane through `point` with the unit normal `normal`.
  static Quadric plane(const Vec3d& normal, const Vec3d& point, double weight) {
    const double offset = -dot(normal, point);
    const Vec3d wn = normal * weight;
    return {wn.x * normal.x, wn.x * normal.y, wn.x * normal.z, wn.y * normal.y, wn.y * normal.z,
            wn.z * normal.z, wn.x * offset,   wn.y * offset,   wn.z * offset,   weight * offset * offset};
  }

  // Adds weight x squared distance to `point`.
  void add_point(const Vec3d& point, double weight) {
    xx += weight, yy += weight, zz += weight;
    bx -= weight * point.x, by -= weight * point.y, bz -= weight * point.z;
    c += weight * squared_length(point);
  }

  Quadric& operator+=(const Quadric& o) {
    xx += o.xx, xy += o.xy, xz += o.xz, yy += o.yy, yz += o.yz, zz += o.zz;
    bx += o.bx, by += o.by, bz += o.bz;
    c += o.c;
    return *this;
  }
  Quadric& operator-=(const Quadric& o) {
    xx -= o.xx, xy -= o.xy, xz -= o.xz, yy -= o.yy, yz -= o.yz, zz -= o.zz;
    bx -= o.bx, by -= o.by, bz -= o.bz;
    c -= o.c;
    return *this;
  }
  Quadric& operator*=(double s) {
    xx *= s, xy *= s, xz *= s, yy *= s, yz *= s, zz *= s;
    bx *= s, by *= s, bz *= s;
    c *= s;
    return *this;
  }
  friend Quadric operator+(Quadric a, const Quadric& b) { return a += b; }
  friend Quadric operator-(Quadric a, const Quadric& b) { return a -= b; }
  friend bool operator==(const Quadric&, const Quadric&) = default;

  // The trace of A: the sum of the weights of its planes, and thrice those of its points.
  double trace() const { return xx + yy + zz; }

  // Q(x). May come out slightly negative by rounding.
  double operator()(const Vec3d& x) const {
    const double rx = xx * x.x + xy * x.y + xz * x.z + 2 * bx;
    const double ry = xy * x.x + yy * x.y + yz * x.z + 2 * by;
    const double rz = xz * x.x + yz * x.y + zz * x.z + 2 * bz;
    return rx * x.x + ry * x.y + rz * x.z + c;
  }
};

struct QuadricMinimum {
  Vec3d point;
  double value = 0;  // >= 0
};

// Where Q is smallest, by an LDL' factorisation. Precondition: A is positive definite, which every quadric is that
// holds a point (see contract/vertex_quadrics.h); a quadric without one gives a finite but meaningless answer.
inline QuadricMinimum minimum(const Quadric& q) {
  const auto inverse = [](double pivot) { return pivot > 1e-300 ? 1.0 / pivot : 0.0; };
  const double i0 = inverse(q.xx);
  const double l10 = q.xy * i0, l20 = q.xz * i0;
  const double i1 = inverse(q.yy - l10 * q.xy);
  const double m21 = q.yz - l20 * q.xy;
  const double l21 = m21 * i1;
  const double i2 = inverse(q.zz - l20 * q.xz - l21 * m21);
  const double y0 = -q.bx;
  const double y1 = -q.by - l10 * y0;
  const double y2 = -q.bz - l20 * y0 - l21 * y1;
  const double z = y2 * i2;
  const double y = y1 * i1 - l21 * z;
  const double x = y0 * i0 - l10 * y - l20 * z;
  const double value = q.c + q.bx * x + q.by * y + q.bz * z;
  return {{x, y, z}, std::max(value, 0.0)};
}

using Double2 = double __attribute__((vector_size(16)));

// The least values of two quadrics, >= 0, in the time of one: what minimum() finds, without the places.
inline Double2 minimum_values(const Quadric& a, const Quadric& b) {
  const auto inverse = [](Double2 pivot) { return pivot > 1e-300 ? 1.0 / pivot : Double2{}; };
  const Double2 xx{a.xx, b.xx}, xy{a.xy, b.xy}, xz{a.xz, b.xz}, yy{a.yy, b.yy}, yz{a.yz, b.yz}, zz{a.zz, b.zz};
  const Double2 i0 = inverse(xx);
  const Double2 l10 = xy * i0, l20 = xz * i0;
  const Double2 i1 = inverse(yy - l10 * xy);
  const Double2 m21 = yz - l20 * xy;
  const Double2 l21 = m21 * i1;
  const Double2 i2 = inverse(zz - l20 * xz - l21 * m21);
  const Double2 y0{a.bx, b.bx};
  const Double2 y1 = Double2{a.by, b.by} - l10 * y0;
  const Double2 y2 = Double2{a.bz, b.bz} - l20 * y0 - l21 * y1;
  const Double2 value = Double2{a.c, b.c} - (y0 * y0 * i0 + y1 * y1 * i1 + y2 * y2 * i2);
  return value > 0 ? value : Double2{};
}

}  // namespace limber
