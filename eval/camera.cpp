// SPDX-License-Identifier: Apache-2.0
#include "eval/camera.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace limber::eval {

Camera frame_camera(const Box& box, const Vec3d& direction, double aspect, const FrameOptions& options) {
  assert(aspect > 0.0);
  const Vec3d low = box.empty() ? Vec3d{-0.5, -0.5, -0.5} : box.low;
  const Vec3d high = box.empty() ? Vec3d{0.5, 0.5, 0.5} : box.high;
  const Vec3d center = (low + high) * 0.5;
  const CameraAxes axes = camera_axes(direction, options.up);
  const double keep = 1.0 - 2.0 * std::clamp(options.margin, 0.0, 0.45);
  const double slope_y = tangent_of_half(options.fov_degrees) * keep;
  const double slope_x = slope_y * aspect;

  // A corner at (x, y, z) in camera axes is inside for an eye at (ex, ey, d) when |x - ex| <= slope (d - z): each side
  // bounds slope * d from below, opposite sides together give the place of the eye.
  double right = 0.0, left = 0.0, above = 0.0, below = 0.0;
  bool first = true;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3d p =
        Vec3d{corner & 1 ? high.x : low.x, corner & 2 ? high.y : low.y, corner & 4 ? high.z : low.z} - center;
    const double x = dot(p, axes.right), y = dot(p, axes.up), z = dot(p, axes.back);
    const auto grow = [&](double& bound, double value) { bound = first ? value : std::max(bound, value); };
    grow(right, x + slope_x * z);
    grow(left, -x + slope_x * z);
    grow(above, y + slope_y * z);
    grow(below, -y + slope_y * z);
    first = false;
  }
  double distance = std::max((right + left) / (2.0 * slope_x), (above + below) / (2.0 * slope_y));
  if (!(distance > 0.0)) distance = 1.0;

  Camera camera;
  camera.target = center + axes.right * ((right - left) * 0.5) + axes.up * ((above - below) * 0.5);
  camera.eye = camera.target + axes.back * distance;
  camera.up = options.up;
  camera.fov_degrees = options.fov_degrees;
  return camera;
}

Projection::Projection(const Camera& camera, int width, int height)
    : eye_(camera.eye),
      axes_(camera_axes(camera)),
      scale_(0.5 * height / tangent_of_half(camera.fov_degrees)),
      center_x_(0.5 * width),
      center_y_(0.5 * height) {
  assert(width >= 1 && height >= 1);
}

ScreenPoint Projection::project(const Vec3d& p) const {
  const Vec3d q = p - eye_;
  const double w = -dot(q, axes_.back);
  return {scale_ * dot(q, axes_.right) + center_x_ * w, -scale_ * dot(q, axes_.up) + center_y_ * w, w};
}

Vec3d Projection::ray(double x, double y) const {
  return axes_.right * ((x - center_x_) / scale_) - axes_.up * ((y - center_y_) / scale_) - axes_.back;
}

}  // namespace limber::eval
