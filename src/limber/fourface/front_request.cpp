// SPDX-License-Identifier: Apache-2.0
#include "limber/fourface/front_request.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "limber/base/portable_math.h"

namespace limber {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

Vec3d unit(const Vec3d& v) {
  const double size = length(v);
  return size > 0 ? v * (1 / size) : Vec3d{};
}

double half_tangent(const Viewpoint& view) {
  const double half = view.fov_degrees * (kPi / 360);
  return portable_sin(half) / portable_sin(kPi / 2 - half);
}

Vec3f normal_of(const FourKMesh& mesh, std::span<const Vec3f> positions, Index t) {
  const auto& [a, b, c] = mesh.triangles[t];
  const Vec3f normal = cross(positions[b] - positions[a], positions[c] - positions[a]);
  const float size = length(normal);
  return size > 0 ? normal * (1 / size) : Vec3f{};
}

// The worst of the limits, as a multiple of it: at most 1 where all are kept.
class Limits {
 public:
  Limits(const FourKMesh& mesh, std::span<const Vec3f> positions, const FrontRequest& request,
         std::span<const float> bend)
      : mesh_(mesh), positions_(positions), request_(request), bend_(bend) {
    if (!request.view) return;
    seen_ = seen_from(*request.view);
    pixels_ = pixels_per_slope(*request.view);
  }

  bool is_outside(Index o) const {
    const auto center = static_cast<Vec3d>(positions_[mesh_.vertex[o]]);
    const auto radius = static_cast<double>(mesh_.radius[o]);
    if (request_.focus && length(center - request_.focus->center) > radius + request_.focus->radius) return true;
    return request_.view && std::ranges::any_of(seen_, [&](const HalfSpace& half) {
             return dot(half.normal, center) + radius < half.offset;
           });
  }

  // In the order of which a budget is used up.
  double importance(Index o) const {
    if (is_outside(o)) return 0;
    if (request_.view) return seen_error(mesh_, positions_, o, request_.view->eye, {}) * pixels_;
    return static_cast<double>(mesh_.error[o]);
  }

  double excess(Index o) const {
    if (is_outside(o)) return 0;
    if (!request_.error && !request_.pixels && !request_.bend) return kInfinite;
    double worst = 0;
    const auto at_most = [&](double value, double limit) {
      if (value > 0) worst = std::max(worst, limit > 0 ? value / limit : kInfinite);
    };
    if (request_.error) at_most(static_cast<double>(mesh_.error[o]), *request_.error);
    if (request_.pixels) at_most(seen_error(mesh_, positions_, o, request_.view->eye, {}) * pixels_, *request_.pixels);
    if (request_.bend) at_most(static_cast<double>(bend_[o]), *request_.bend);
    return worst;
  }

 private:
  const FourKMesh& mesh_;
  std::span<const Vec3f> positions_;
  const FrontRequest& request_;
  std::span<const float> bend_;
  std::array<HalfSpace, 5> seen_;
  double pixels_ = 0;
};

}  // namespace

double pixels_per_slope(const Viewpoint& view) { return view.height / (2 * half_tangent(view)); }

std::array<HalfSpace, 5> seen_from(const Viewpoint& view) {
  const Vec3d forward = unit(view.target - view.eye);
  Vec3d right = cross(forward, view.up);
  if (!(squared_length(right) > 1e-18 * squared_length(view.up)))
    right = cross(forward, std::fabs(forward.x) < 0.5 ? Vec3d{1, 0, 0} : Vec3d{0, 0, 1});
  right = unit(right);
  const Vec3d up = cross(right, forward);
  const double high = half_tangent(view), wide = high * view.width / view.height;
  const Vec3d normals[] = {forward, forward * wide + right, forward * wide - right, forward * high + up,
                           forward * high - up};
  std::array<HalfSpace, 5> seen;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    seen[i].normal = unit(normals[i]);
    seen[i].offset = dot(seen[i].normal, view.eye);
  }
  return seen;
}

std::vector<float> bends(const FourKMesh& mesh, std::span<const Vec3f> positions) {
  std::vector<float> all(mesh.operation_count(), 0.0f);
  std::vector<Vec3f> normals;
  for (Index o = 0; o < mesh.operation_count(); ++o) {
    float& bend = all[o];
    normals.clear();
    for (const Index t : mesh.destroyed_by(o)) {
      normals.push_back(normal_of(mesh, positions, t));
      if (mesh.creator[t] != kNone) bend = std::max(bend, all[mesh.creator[t]]);
    }
    for (Index t = mesh.created_begin[o]; t < mesh.created_begin[o + 1]; ++t)
      normals.push_back(normal_of(mesh, positions, t));
    for (std::size_t i = 0; i < normals.size(); ++i) {
      // A triangle without area is not bent.
      if (normals[i] == Vec3f{}) continue;
      for (std::size_t j = 0; j < i; ++j)
        if (normals[j] != Vec3f{}) bend = std::max(bend, 1 - dot(normals[i], normals[j]));
    }
  }
  return all;
}

std::vector<std::uint8_t> applied_operations(const FourKMesh& mesh, std::span<const Vec3f> positions,
                                             const FrontRequest& request, std::span<const float> bend) {
  assert(!request.level && !request.vertices && !request.triangles);
  const Limits limits(mesh, positions, request, bend);
  std::vector<std::uint8_t> applied(mesh.operation_count());
  for (Index o = 0; o < mesh.operation_count(); ++o) applied[o] = limits.excess(o) <= 1;
  return applied;
}

void move_front(Front& front, const FourKMesh& mesh, std::span<const Vec3f> positions, const FrontRequest& request,
                std::span<const float> bend, double hysteresis) {
  assert(hysteresis >= 1 && (!request.pixels || request.view) &&
         (!request.bend || bend.size() == mesh.operation_count()));
  const Limits limits(mesh, positions, request, bend);
  const bool is_calm = hysteresis > 1;
  if (is_calm) front.remember();
  const auto calm = [&](Index o, double value) { return is_calm && front.was_applied(o) ? value / hysteresis : value; };
  if (request.level) {
    const Index end = mesh.level_begin[std::min(*request.level, mesh.level_count())];
    front.move([end](Index o) { return o < end; });
  } else if (request.vertices || request.triangles) {
    front.move_to_budget([&](Index o) { return calm(o, limits.importance(o)); },
                         request.vertices ? *request.vertices : *request.triangles,
                         request.vertices ? FrontBudget::kVertices : FrontBudget::kTriangles);
  } else {
    front.move([&](Index o) { return calm(o, limits.excess(o)) <= 1; });
  }
}

}  // namespace limber
