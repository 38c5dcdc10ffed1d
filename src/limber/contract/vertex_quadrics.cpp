// SPDX-License-Identifier: Apache-2.0
#include "limber/contract/vertex_quadrics.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <type_traits>

#include "limber/contract/bounds.h"

namespace limber {
namespace {

// A quadric's numbers two by two, in their order: compilers do not pair them by themselves.
struct PairedQuadric {
  Double2 pairs[5];

  // As Quadric::plane().
  PairedQuadric(const Vec3d& normal, const Vec3d& point, double weight) {
    const double offset = -dot(normal, point);
    const Vec3d wn = normal * weight;
    pairs[0] = wn.x * Double2{normal.x, normal.y};
    pairs[1] = Double2{wn.x, wn.y} * Double2{normal.z, normal.y};
    pairs[2] = Double2{wn.y, wn.z} * normal.z;
    pairs[3] = Double2{wn.x, wn.y} * offset;
    pairs[4] = Double2{wn.z, weight * offset} * offset;
  }

  void add_to(Quadric& quadric) const {
    static_assert(sizeof(Quadric) == sizeof pairs && std::is_trivially_copyable_v<Quadric>);
    Double2 sum[5];
    std::memcpy(sum, &quadric, sizeof sum);
    for (int i = 0; i < 5; ++i) sum[i] += pairs[i];
    std::memcpy(&quadric, sum, sizeof sum);
  }
};

}  // namespace

Normalization normalization(std::span<const Vec3f> positions) {
  const Box box = bounds(positions);
  const double scale = 1 / box.diagonal();
  return {box.center(), std::isfinite(scale) ? scale : 1.0};
}

VertexQuadrics::VertexQuadrics(const Mesh& mesh, const Edges& edges, const QuadricOptions& options)
    : triangles_(mesh.triangles), options_(options), facings_(mesh.vertex_count) {
  for (Index e = 0; e < edges.ends.size(); ++e)
    if (edges.triangle_count[e] == 1)
      border_edges_.push_back({edges.ends[e][0], edges.ends[e][1], edges.some_triangle[e]});
}

void VertexQuadrics::compute(std::span<const Vec3d> positions, std::span<Quadric> quadrics) {
  assert(positions.size() == facings_.size() && quadrics.size() == facings_.size());
  std::fill(quadrics.begin(), quadrics.end(), Quadric{});
  std::fill(facings_.begin(), facings_.end(), Facing{});
  double total_area = 0;
  for (const auto& [a, b, c] : triangles_) {
    const Vec3d& p = positions[a];
    const Vec3d normal = cross(positions[b] - p, positions[c] - p);  // twice the area long
    const double doubled_area = length(normal);
    if (!(doubled_area > 0)) continue;
    const double third = doubled_area * (1.0 / 6);
    const PairedQuadric q(normal * (1 / doubled_area), p, third);
    const Facing third_facing{normal * (1.0 / 6), third};
    for (const Index v : {a, b, c}) q.add_to(quadrics[v]), facings_[v] += third_facing;
    total_area += doubled_area * 0.5;
  }
  for (const auto& [from, to, triangle] : border_edges_) {
    const auto& [a, b, c] = triangles_[triangle];
    const Vec3d normal = cross(positions[b] - positions[a], positions[c] - positions[a]);
    const Vec3d edge = positions[to] - positions[from];
    const Vec3d across = cross(edge, normal);
    const double across_length = length(across);
    if (!(across_length > 0)) continue;
    const Quadric q = Quadric::plane(across * (1 / across_length), positions[from],
                                     options_.border_weight * 0.5 * squared_length(edge));
    quadrics[from] += q, quadrics[to] += q;
  }
  // A vertex without area still needs a place of its own.
  const auto vertex_count = static_cast<double>(facings_.size());
  const double least_area = total_area > 0 ? 1e-6 * total_area / vertex_count : 1 / vertex_count;
  // Where triangles are slivers, a border is all that counts; the point must not drown in the rounding of its planes.
  constexpr double kLeastShare = 1e-10;
  for (std::size_t v = 0; v < facings_.size(); ++v) {
    Quadric& q = quadrics[v];
    const double weight = options_.point_weight * std::max(facings_[v].area, least_area);
    q.add_point(positions[v], std::max(weight, kLeastShare * q.trace()));
  }
}

}  // namespace limber
