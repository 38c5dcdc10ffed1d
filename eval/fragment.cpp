// SPDX-License-Identifier: Apache-2.0
#include "eval/fragment.h"

#include <algorithm>
#include <cmath>

#include "eval/normals.h"
#include "eval/parallel_for.h"
#include "eval/srgb.h"

namespace limber::eval {

Scene make_scene(const Subject& subject, const Camera& camera, const RenderOptions& options) {
  Scene scene{.subject = subject, .options = options, .projection = Projection(camera, options.width, options.height)};
  scene.near = std::max(1e-5 * length(camera.eye - camera.target), 1e-30);
  scene.extent = bounding_box(subject.triangles, subject.positions).diagonal();
  scene.points.resize(subject.positions.size());
  scene.boxes.resize(subject.triangles.size());
  parallel_for_ranges(scene.points.size(), 4096, [&](std::size_t first, std::size_t end) {
    for (std::size_t i = first; i < end; ++i) {
      scene.points[i] = scene.projection.project(Vec3d(subject.positions[i]));
    }
  });
  parallel_for_ranges(scene.boxes.size(), 4096, [&](std::size_t first, std::size_t end) {
    for (std::size_t i = first; i < end; ++i) {
      const Triangle& t = subject.triangles[i];
      const ScreenPoint corners[3] = {scene.points[t[0]], scene.points[t[1]], scene.points[t[2]]};
      scene.boxes[i] = pixel_box(corners, options.width, options.height, 0.0);
    }
  });
  scene.bins = bin_boxes(scene.boxes, options.width, options.height);
  if (options.shading == Shading::kSmooth) {
    if (subject.normals.empty()) scene.own_normals = vertex_normals(subject.triangles, subject.positions);
    scene.normals = subject.normals.empty() ? std::span<const Vec3f>(scene.own_normals) : subject.normals;
  }
  return scene;
}

Fragment fragment_at(const Scene& scene, Index t, double x, double y) {
  const Triangle& corner = scene.subject.triangles[t];
  const EdgeFunctions e = edge_functions(scene.points[corner[0]], scene.points[corner[1]], scene.points[corner[2]]);
  Fragment f;
  double sum = 0.0;
  for (int k = 0; k < 3; ++k) sum += f.weights[k] = std::max(0.0, e.at(k, x, y));
  const double scale = sum > 0.0 ? 1.0 / sum : 0.0;
  for (double& weight : f.weights) weight = sum > 0.0 ? weight * scale : 1.0 / 3.0;
  f.inverse_depth = static_cast<float>(sum / e.det);
  f.front = e.front;

  Vec3d p[3];
  for (std::size_t k = 0; k < 3; ++k) p[k] = Vec3d(scene.subject.positions[corner[k]]);
  const Vec3d position = p[0] * f.weights[0] + p[1] * f.weights[1] + p[2] * f.weights[2];
  f.position = Vec3f(position);
  f.to_eye = unit_or(Vec3f(scene.projection.eye() - position), Vec3f(scene.projection.axes().back));
  // In the triangle's own size: its cross product in single precision may vanish.
  const Vec3d area = cross(p[1] - p[0], p[2] - p[0]);
  const double area_length = length(area);
  f.facing = area_length > 0.0 ? Vec3f(area * (1.0 / area_length)) : f.to_eye;
  if (!f.front) f.facing = -f.facing;
  f.normal = f.facing;
  if (!scene.normals.empty()) {
    Vec3f smooth{};
    for (std::size_t k = 0; k < 3; ++k) smooth += scene.normals[corner[k]] * static_cast<float>(f.weights[k]);
    if (!f.front) smooth = -smooth;
    f.normal = unit_or(smooth, f.facing);
  }
  f.normal = normal_before_eye(f.normal, f.to_eye);
  return f;
}

Albedo albedo_of(const Scene& scene, Index t, const Fragment& fragment) {
  const Triangle& corner = scene.subject.triangles[t];
  const RenderOptions& options = scene.options;
  const float w[3] = {static_cast<float>(fragment.weights[0]), static_cast<float>(fragment.weights[1]),
                      static_cast<float>(fragment.weights[2])};
  if (!scene.subject.values.empty()) {
    const std::span<const float> values = scene.subject.values;
    const float value = values[corner[0]] * w[0] + values[corner[1]] * w[1] + values[corner[2]] * w[2];
    const float range = options.high_value - options.low_value;
    if (std::isfinite(value)) {
      return {map_color(options.color_map, range != 0.0f ? (value - options.low_value) / range : 0.0f), true};
    }
  } else if (!scene.subject.colors.empty()) {
    const std::span<const Rgba8> colors = scene.subject.colors;
    return {linear_from_srgb(colors[corner[0]]) * w[0] + linear_from_srgb(colors[corner[1]]) * w[1] +
                linear_from_srgb(colors[corner[2]]) * w[2],
            false};
  }
  return {linear_from_srgb(fragment.front ? options.material : options.back_material), false};
}

}  // namespace limber::eval
