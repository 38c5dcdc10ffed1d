// SPDX-License-Identifier: Apache-2.0
#include "limber/view/seen_weights.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace limber {

namespace {

// The angle between surface and line of sight up to which it is silhouette has this sine.
constexpr float kSilhouetteBand = 0.25f;

// Nearer than this, in distances from the eye to the target, nothing is seen.
constexpr double kNear = 1e-4;

double diagonal(std::span<const Vec3f> positions) {
  Box box;
  for (const Vec3f& p : positions) box.add(Vec3d(p));
  return box.diagonal();
}

float ramp(float x) { return std::clamp(x, 0.0f, 1.0f); }

void weigh_focus(const Focus& focus, std::span<const Vec3f> positions, std::span<float> weights) {
  const Vec3f center(focus.center);
  const auto radius = static_cast<float>(focus.radius);
  for (std::size_t v = 0; v < positions.size(); ++v) {
    const float beyond = length(positions[v] - center) / radius - 1;
    weights[v] /= 1 + (focus.outside - 1) * ramp(beyond);
  }
}

void weigh_along(const Along& along, std::span<const Vec3f> positions, std::span<float> weights) {
  constexpr std::array<float Vec3f::*, 3> kAxes{&Vec3f::x, &Vec3f::y, &Vec3f::z};
  const auto axis = kAxes[static_cast<std::size_t>(along.axis)];
  const auto from = static_cast<float>(along.from);
  const float rate = along.to == along.from ? 0 : static_cast<float>(1 / (along.to - along.from));
  for (std::size_t v = 0; v < positions.size(); ++v) {
    weights[v] /= 1 + (along.coarsest - 1) * ramp((positions[v].*axis - from) * rate);
  }
}

}  // namespace

void SeenWeights::measure_reach(const Mesh& mesh, std::span<const Vec3f> positions) {
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Index from = t[k], to = t[(k + 1) % 3];
      const float square = squared_length(positions[from] - positions[to]);
      reach_[from] = std::max(reach_[from], square);
      reach_[to] = std::max(reach_[to], square);
    }
  }
  for (float& reach : reach_) reach = std::sqrt(reach);
}

void SeenWeights::see_through(const Camera& camera, const View& view, float limit, std::span<const Vec3f> positions) {
  const CameraAxes axes = camera_axes(camera);
  const Vec3f eye(camera.eye), right(axes.right), up(axes.up), ahead(-axes.back);
  const double slope_y = tangent_of_half(camera.fov_degrees);
  const double slope_x = slope_y * view.width / view.height;
  const auto unit_of_plane = [](double slope) { return static_cast<float>(1 / std::sqrt(1 + slope * slope)); };
  const float side_x = unit_of_plane(slope_x), side_y = unit_of_plane(slope_y);
  const float depth_x = side_x * static_cast<float>(slope_x), depth_y = side_y * static_cast<float>(slope_y);
  const auto near = static_cast<float>(kNear * length(camera.eye - camera.target));
  const auto pixel = static_cast<float>(slope_y / (0.5 * view.height));  // at depth 1
  const float beside = 0.5f / limit;
  for (std::size_t v = 0; v < positions.size(); ++v) {
    const Vec3f q = positions[v] - eye;
    const float x = std::abs(dot(q, right)), y = std::abs(dot(q, up)), z = dot(q, ahead);
    const float outside = std::max({x * side_x - z * depth_x, y * side_y - z * depth_y, near - z}) - reach_[v];
    weights_[v] = 1 / (std::max(z - reach_[v], near) * pixel + std::max(outside, 0.0f) * beside);
  }
}

void SeenWeights::sum_area_vectors(const Mesh& mesh, std::span<const Vec3f> positions) {
  area_vectors_.assign(positions.size(), Vec3f{});
  for (const Triangle& t : mesh.triangles) {
    const Vec3f a = positions[t[0]];
    const Vec3f vector = cross(positions[t[1]] - a, positions[t[2]] - a);
    for (const Index corner : t) area_vectors_[corner] += vector;
  }
}

void SeenWeights::weigh_facing(const View& view, std::span<const Vec3f> positions) {
  const Vec3f eye(view.camera->eye);
  const float on_silhouette = 1 / view.silhouettes;
  for (std::size_t v = 0; v < positions.size(); ++v) {
    const Vec3f sight = eye - positions[v], normal = area_vectors_[v];
    const float scale = std::sqrt(squared_length(sight) * squared_length(normal));
    if (!(scale > 0)) continue;
    const float cosine = dot(normal, sight) / scale;
    const float share = ramp(std::abs(cosine) / kSilhouetteBand), side = cosine >= 0 ? 1.0f : view.facing_away;
    weights_[v] /= on_silhouette + (side - on_silhouette) * share;
  }
}

void SeenWeights::measure(const Mesh& mesh, std::span<const Vec3f> positions, const View& view, float limit,
                          bool for_triangles) {
  assert(positions.size() == mesh.vertex_count && limit > 0 && view.width >= 1 && view.height >= 1);
  assert(view.silhouettes >= 1 && view.facing_away >= 1);
  weights_.resize(positions.size());
  if (view.camera) {
    reach_.assign(positions.size(), 0.0f);
    if (for_triangles) measure_reach(mesh, positions);
    see_through(*view.camera, view, limit, positions);
    if (view.silhouettes > 1 || view.facing_away > 1) {
      sum_area_vectors(mesh, positions);
      weigh_facing(view, positions);
    }
  } else {
    const double whole = diagonal(positions);
    std::fill(weights_.begin(), weights_.end(), whole > 0 ? static_cast<float>(100 / whole) : 1.0f);
  }
  if (view.focus) weigh_focus(*view.focus, positions, weights_);
  if (view.along) weigh_along(*view.along, positions, weights_);
}

}  // namespace limber
