// SPDX-License-Identifier: Apache-2.0
#include "limber/view/camera.h"

#include <algorithm>
#include <cmath>

namespace limber {

namespace {

Vec3d unit_or(const Vec3d& v, const Vec3d& otherwise) {
  const double l = length(v);
  return l > 0.0 && std::isfinite(l) ? v * (1.0 / l) : otherwise;
}

}  // namespace

CameraAxes camera_axes(const Vec3d& towards_eye, const Vec3d& up) {
  const Vec3d back = unit_or(towards_eye, {0.0, 0.0, 1.0});
  Vec3d right = cross(unit_or(up, {0.0, 1.0, 0.0}), back);
  if (squared_length(right) < 1e-12) right = cross(Vec3d{0.0, 0.0, -1.0}, back);
  if (squared_length(right) < 1e-12) right = cross(Vec3d{0.0, 1.0, 0.0}, back);
  right = unit_or(right, {1.0, 0.0, 0.0});
  return {right, cross(back, right), back};
}

// By the series of sine and cosine.
double tangent_of_half(double degrees) {
  constexpr double kPi = 3.14159265358979323846;
  const double x = std::clamp(degrees, 0.01, 120.0) * (kPi / 360.0);
  double sine = 0.0, cosine = 0.0, term = 1.0;
  for (int k = 0; k < 24; k += 2) {
    cosine += term;
    term *= x / (k + 1);
    sine += term;
    term *= -x / (k + 2);
  }
  return sine / cosine;
}

}  // namespace limber
