// SPDX-License-Identifier: Apache-2.0
#include "eval/methods/feature_quadrics.h"

#include <algorithm>

#include "eval/methods/feature_weight.h"
#include "limber/base/portable_math.h"

namespace limber::eval {

FeatureQuadrics::FeatureQuadrics(const Mesh& mesh, std::span<const Vec3f> first, std::span<const Vec3f> last,
                                 const MethodOptions& options)
    : mesh_(mesh),
      options_(options.contract.quadrics),
      literal_(options.feature.literal),
      plain_(mesh, options.contract.quadrics),
      areas_(mesh.vertex_count) {
  if (literal_) return;
  Surface surface(mesh);
  const double sharp_cosine = portable_cos(options.feature.sharp_angle * (kPi / 180));
  const FramePositions frames[] = {{first, 1, 0}, {last, 1, 0}};
  for (Index e = 0; e < surface.edge_count(); ++e) {
    if (surface.triangle_count(e) != 2) continue;
    if (!std::ranges::all_of(frames,
                             [&](const auto& frame) { return meeting_cosine(surface, e, frame) > sharp_cosine; }))
      continue;
    const auto [u, v] = surface.ends(e);
    surface.for_each_triangle(u, [&, u = u, v = v](Index t) {
      const Triangle& corners = surface.triangle(t);
      if (std::ranges::find(corners, v) != corners.end())
        creases_.push_back({u, v, corners[0] ^ corners[1] ^ corners[2] ^ u ^ v});
    });
  }
}

void FeatureQuadrics::compute_literal(std::span<const Vec3d> positions, std::span<Quadric> quadrics) {
  std::ranges::fill(quadrics, Quadric{});
  std::ranges::fill(areas_, 0.0);
  for (const Triangle& t : mesh_.triangles) {
    const Vec3d& p = positions[t[0]];
    const Vec3d normal = cross(positions[t[1]] - p, positions[t[2]] - p);
    const double doubled_area = length(normal);
    if (!(doubled_area > 0)) continue;
    const Quadric q = Quadric::plane(normal * (1 / doubled_area), p, 1);
    for (const Index corner : t) {
      quadrics[corner] += q;
      areas_[corner] += doubled_area / 2;
    }
  }
  for (std::size_t v = 0; v < quadrics.size(); ++v) {
    Quadric& q = quadrics[v];
    const double w = areas_[v] > 0 ? areas_[v] : 1e-12;
    q.xx *= w, q.xy *= w, q.xz *= w, q.yy *= w, q.yz *= w, q.zz *= w;
    q.bx *= w, q.by *= w, q.bz *= w, q.c *= w;
    q.add_point(positions[v], options_.point_weight * w);
  }
}

void FeatureQuadrics::compute(std::span<const Vec3d> positions, std::span<Quadric> quadrics) {
  if (literal_) {
    compute_literal(positions, quadrics);
    return;
  }
  plain_.compute(positions, quadrics);
  for (const auto& [from, to, opposite] : creases_) {
    const Vec3d along = positions[to] - positions[from];
    const Vec3d across = cross(along, cross(along, positions[opposite] - positions[from]));
    const double across_length = length(across);
    if (!(across_length > 0)) continue;
    const Quadric q = Quadric::plane(across * (1 / across_length), positions[from],
                                     options_.border_weight * 0.5 * squared_length(along));
    quadrics[from] += q, quadrics[to] += q;
  }
}

}  // namespace limber::eval
