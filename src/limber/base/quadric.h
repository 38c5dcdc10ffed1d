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

using Double2 = double __attribute__((vector_size(16)));

// Half of solving A x = -b by A = L D L': y = -L^-1 b. Of one quadric or, with Double2, of two at once.
template <class Real>
struct Elimination {
  Real i0, i1, i2;  // the reciprocals of D
  Real l10, l20, l21;
  Real y0, y1, y2;

  // number(&Quadric::xx) and so on: what it is of.
  template <class Number>
  explicit Elimination(const Number& number) {
    const auto inverse = [](Real pivot) { return pivot > 1e-300 ? 1.0 / pivot : Real{}; };
    const Real xy = number(&Quadric::xy), xz = number(&Quadric::xz);
    i0 = inverse(number(&Quadric::xx));
    l10 = xy * i0, l20 = xz * i0;
    i1 = inverse(number(&Quadric::yy) - l10 * xy);
    const Real m21 = number(&Quadric::yz) - l20 * xy;
    l21 = m21 * i1;
    i2 = inverse(number(&Quadric::zz) - l20 * xz - l21 * m21);
    y0 = -number(&Quadric::bx);
    y1 = -number(&Quadric::by) - l10 * y0;
    y2 = -number(&Quadric::bz) - l20 * y0 - l21 * y1;
  }
};

// Where Q is smallest. Precondition: A is positive definite, which every quadric is that holds a point (see
// contract/vertex_quadrics.h); a quadric without one gives a finite but meaningless answer.
inline QuadricMinimum minimum(const Quadric& q) {
  const Elimination<double> e([&](double Quadric::*number) { return q.*number; });
  const double z = e.y2 * e.i2;
  const double y = e.y1 * e.i1 - e.l21 * z;
  const double x = e.y0 * e.i0 - e.l10 * y - e.l20 * z;
  const double value = q.c + q.bx * x + q.by * y + q.bz * z;
  return {{x, y, z}, std::max(value, 0.0)};
}

// The least values of two quadrics, >= 0, in the time of one: what minimum() finds, without the places.
inline Double2 minimum_values(const Quadric& p, const Quadric& q) {
  const Elimination<Double2> e([&](double Quadric::*number) { return Double2{p.*number, q.*number}; });
  const Double2 value = Double2{p.c, q.c} - (e.y0 * e.y0 * e.i0 + e.y1 * e.y1 * e.i1 + e.y2 * e.y2 * e.i2);
  return value > 0 ? value : Double2{};
}

}  // namespace limber
