// SPDX-License-Identifier: Apache-2.0
// Where a picture is taken from, and where in it a point is seen.
#pragma once

#include "limber/base/vec.h"
#include "limber/view/camera.h"

namespace limber::eval {

using limber::Camera;
using limber::camera_axes;
using limber::CameraAxes;

struct FrameOptions {
  Vec3d up{0.0, 1.0, 0.0};
  double fov_degrees = 24.0;
  double margin = 0.06;  // free space on each side, as a share of the picture, in [0, 0.45]
};

// The nearest camera that sees the whole box with the margin free. `direction` points from the box towards the eye;
// aspect is width / height of the picture. For a clip, give the box around all its frames. An empty box counts as the
// unit cube around the origin; where `up` is parallel to `direction`, another axis stands in.
Camera frame_camera(const Box& box, const Vec3d& direction, double aspect, const FrameOptions& options = {});

// Homogeneous pixel coordinates: the pixel is (x / w, y / w), y downwards, the centre of the first pixel at (0.5, 0.5);
// w is the distance from the eye along the view direction.
struct ScreenPoint {
  double x = 0.0, y = 0.0, w = 0.0;
};

// World to picture for one picture size.
class Projection {
 public:
  // Precondition: width and height are at least 1.
  Projection(const Camera& camera, int width, int height);

  ScreenPoint project(const Vec3d& p) const;

  // From the eye through a place in the picture, not normalised: its part along the view direction is 1.
  Vec3d ray(double x, double y) const;

  const Vec3d& eye() const { return eye_; }
  const CameraAxes& axes() const { return axes_; }

 private:
  Vec3d eye_;
  CameraAxes axes_;
  double scale_ = 1.0;  // pixels per unit at distance 1
  double center_x_ = 0.0, center_y_ = 0.0;
};

}  // namespace limber::eval
