// SPDX-License-Identifier: Apache-2.0
#include "eval/screen_error.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <random>
#include <vector>

#include "eval/sample_surface.h"

namespace limber::eval {
namespace {

// Pixels of a length at places of a picture.
class Ruler {
 public:
  explicit Ruler(const View& view) : eye_(view.camera->eye), axes_(camera_axes(*view.camera)) {
    slope_y_ = tangent_of_half(view.camera->fov_degrees);
    slope_x_ = slope_y_ * view.width / view.height;
    scale_ = 0.5 * view.height / slope_y_;
  }

  // 0 outside the picture.
  double pixels(const Vec3d& place) const {
    const Vec3d q = place - eye_;
    const double depth = -dot(q, axes_.back);
    if (!(depth > 0) || std::abs(dot(q, axes_.right)) > slope_x_ * depth ||
        std::abs(dot(q, axes_.up)) > slope_y_ * depth)
      return 0;
    return scale_ / depth;
  }

 private:
  Vec3d eye_;
  CameraAxes axes_;
  double slope_x_ = 1, slope_y_ = 1, scale_ = 1;
};

std::vector<Vec3d> points_on(const Surface& surface, bool with_sides, std::size_t sample_count, std::uint64_t seed) {
  std::vector<Vec3d> points;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      points.push_back(corner(surface, t, k));
      if (with_sides) points.push_back((corner(surface, t, k) + corner(surface, t, (k + 1) % 3)) * 0.5);
    }
  }
  const AreaSamples samples(surface, sample_count, seed);
  std::vector<SurfaceSample> list(samples.size());
  samples.fill(0, list);
  for (const SurfaceSample& sample : list) points.push_back(point_at(surface, sample.triangle, sample.barycentric));
  return points;
}

double largest_error(std::vector<Vec3d> points, const ClosestPointTree& tree, const Ruler& ruler, std::size_t& count) {
  std::erase_if(points, [&](const Vec3d& point) { return ruler.pixels(point) == 0; });
  count += points.size();
  std::vector<ClosestPoint> closest(points.size());
  tree.closest(points, closest);
  double largest = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    largest = std::max(largest, std::sqrt(closest[i].squared_distance) * ruler.pixels(points[i]));
  return largest;
}

double between(std::mt19937_64& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
}

}  // namespace

ScreenError measure_screen_error(const Surface& original, const ClosestPointTree& original_tree, const Surface& drawn,
                                 const ClosestPointTree& drawn_tree, const View& view, std::size_t sample_count) {
  assert(view.camera);
  const Ruler ruler(view);
  ScreenError error;
  error.to_drawn = largest_error(points_on(original, false, sample_count, 1), drawn_tree, ruler, error.point_count);
  error.to_original = largest_error(points_on(drawn, true, sample_count, 2), original_tree, ruler, error.point_count);
  return error;
}

View random_view(const Box& box, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto in_cube = [&] {
    const double x = between(random, -1, 1), y = between(random, -1, 1), z = between(random, -1, 1);
    return Vec3d{x, y, z};
  };
  Vec3d direction = in_cube();
  while (squared_length(direction) > 1 || squared_length(direction) < 1e-6) direction = in_cube();
  Camera camera;
  camera.target = box.center() + in_cube() * (0.25 * box.diagonal());
  const double distance = box.diagonal() * 0.3 * std::pow(10.0, between(random, 0, 1));
  camera.eye = camera.target + direction * (distance / length(direction));
  camera.fov_degrees = between(random, 20, 60);
  return {.camera = camera, .width = 1280, .height = 960};
}

double random_pixels(std::uint64_t seed) {
  std::mt19937_64 random(seed ^ 0x9e3779b97f4a7c15u);
  return 0.5 * std::pow(8.0, between(random, 0, 1));
}

}  // namespace limber::eval
