// SPDX-License-Identifier: Apache-2.0
// Closest points by Embree's point queries: Embree walks its box tree and calls `visit` for each triangle whose box
// meets the query's sphere; `visit` measures the triangle and shrinks the sphere.
//
//   closest(p, hint):
//     best = hint's distance, or infinity
//     for each triangle whose box is nearer than best + margin: visit
//       best = min(best, (distance, triangle))
//
// The margin covers every rounding to single precision on the way. So no triangle at the smallest distance is ever
// passed over, and the minimum over (distance, triangle) does not depend on the shape of the tree or on the hint.
#include "eval/closest_point.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <embree3/rtcore.h>
#include <limits>
#include <tuple>
#include <vector>

#include "eval/parallel_for.h"

namespace limber::eval {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Relative to the size of the coordinates that Embree sees: 16 units in the last place.
constexpr double kMargin = 0x1p-20;

// A triangle whose squared sine at the first corner is smaller is measured by its edges alone: its normal is noise.
constexpr double kDegenerate = 1e-20;

// Planes of triangles flatter than this are too uncertain to rule a triangle out.
constexpr double kNeedle = 1e-8;

struct Corners {
  Vec3f a, b, c;
};

struct SegmentPoint {
  double parameter;
  Vec3d point;
  double squared_distance;
};

SegmentPoint closest_on_segment(const Vec3d& p, const Vec3d& from, const Vec3d& edge) {
  const double squared = squared_length(edge);
  const double t = squared > 0 ? std::clamp(dot(p - from, edge) / squared, 0.0, 1.0) : 0.0;
  const Vec3d point = from + edge * t;
  return {t, point, squared_length(p - point)};
}

// The triangle a, a+ab, a+ac. Gives nothing (an infinite distance) where the plane alone is clearly farther than
// `bound`.
ClosestPoint closest_within(const Vec3d& p, const Vec3d& a, const Vec3d& ab, const Vec3d& ac, double bound) {
  ClosestPoint best;
  best.squared_distance = kInfinity;
  const Vec3d ap = p - a;
  const Vec3d n = cross(ab, ac);
  const double nn = squared_length(n);
  const double shape = squared_length(ab) * squared_length(ac);
  const double height = dot(n, ap);
  // Generous, so that rounding never rejects a triangle whose computed distance is the bound itself.
  if (nn > kNeedle * shape && height * height > nn * (bound * (1 + 1e-6) + 1e-16 * squared_length(ap))) return best;

  const bool flat = !(nn > kDegenerate * shape);
  const Vec3d side = cross(ap, n);
  const double weight_c = dot(ab, side);  // signed areas of the parts opposite to c, b and a, times |n|
  const double weight_b = -dot(ac, side);
  const double weight_a = nn - weight_b - weight_c;
  if (!flat && weight_a >= 0 && weight_b >= 0 && weight_c >= 0) {
    best.point = p - n * (height / nn);
    best.squared_distance = height * height / nn;
    const double wb = weight_b / nn, wc = weight_c / nn;
    best.barycentric = {std::max(0.0, 1 - wb - wc), wb, wc};
    return best;
  }
  // Outside, the closest point lies on an edge that has p on its outer side.
  const auto take = [&](const SegmentPoint& s, std::array<double, 3> barycentric) {
    if (s.squared_distance < best.squared_distance) best = {s.point, s.squared_distance, kNone, barycentric};
  };
  if (flat || weight_c < 0) {
    const SegmentPoint s = closest_on_segment(p, a, ab);
    take(s, {1 - s.parameter, s.parameter, 0});
  }
  if (flat || weight_b < 0) {
    const SegmentPoint s = closest_on_segment(p, a, ac);
    take(s, {1 - s.parameter, 0, s.parameter});
  }
  if (flat || weight_a < 0) {
    const SegmentPoint s = closest_on_segment(p, a + ab, ac - ab);
    take(s, {0, 1 - s.parameter, s.parameter});
  }
  return best;
}

// The query under way; Embree hands it back to `visit`.
struct Query {
  std::span<const Corners> corners;
  Vec3d p;
  double scale = 1;   // from lengths of the surface to Embree's
  double margin = 0;  // in Embree's lengths
  ClosestPoint best{};

  bool improve(Index t) {
    const Corners& corner = corners[t];
    const Vec3d a(corner.a);
    ClosestPoint found = closest_within(p, a, Vec3d(corner.b) - a, Vec3d(corner.c) - a, best.squared_distance);
    if (found.squared_distance > best.squared_distance) return false;
    if (found.squared_distance == best.squared_distance && t >= best.triangle) return false;
    best = found;
    best.triangle = t;
    return true;
  }

  float radius() const { return static_cast<float>(std::sqrt(best.squared_distance) * scale * (1 + 1e-6) + margin); }
};

bool visit(RTCPointQueryFunctionArguments* arguments) {
  Query& query = *static_cast<Query*>(arguments->userPtr);
  if (!query.improve(arguments->primID)) return false;
  arguments->query->radius = std::min(arguments->query->radius, query.radius());
  return true;
}

template <auto release>
struct Release {
  template <class T>
  void operator()(T* handle) const {
    release(handle);
  }
};
using Device = std::unique_ptr<RTCDeviceTy, Release<rtcReleaseDevice>>;
using Scene = std::unique_ptr<RTCSceneTy, Release<rtcReleaseScene>>;
using Geometry = std::unique_ptr<RTCGeometryTy, Release<rtcReleaseGeometry>>;

}  // namespace

struct ClosestPointTree::State {
  std::vector<Corners> corners;
  Vec3d centre;
  double scale = 1;  // a power of two: takes the surface to a diagonal of about 1
  Device device{rtcNewDevice(nullptr)};
  Scene scene;

  // Rounded to nearest; the margin of the queries makes up for it.
  Vec3f to_embree(const Vec3d& p) const { return Vec3f((p - centre) * scale); }

  static void bounds(const RTCBoundsFunctionArguments* arguments) {
    const State& state = *static_cast<const State*>(arguments->geometryUserPtr);
    const Corners& t = state.corners[arguments->primID];
    const Vec3f a = state.to_embree(Vec3d(t.a)), b = state.to_embree(Vec3d(t.b)), c = state.to_embree(Vec3d(t.c));
    RTCBounds& out = *arguments->bounds_o;
    std::tie(out.lower_x, out.upper_x) = std::minmax({a.x, b.x, c.x});
    std::tie(out.lower_y, out.upper_y) = std::minmax({a.y, b.y, c.y});
    std::tie(out.lower_z, out.upper_z) = std::minmax({a.z, b.z, c.z});
  }
};

ClosestPoint closest_point_on_triangle(const Vec3d& p, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  return closest_within(p, a, b - a, c - a, kInfinity);
}

ClosestPointTree::ClosestPointTree() : state_(std::make_unique<State>()) {}
ClosestPointTree::ClosestPointTree(ClosestPointTree&&) noexcept = default;
ClosestPointTree& ClosestPointTree::operator=(ClosestPointTree&&) noexcept = default;
ClosestPointTree::~ClosestPointTree() = default;

void ClosestPointTree::rebuild(const Surface& surface) {
  State& state = *state_;
  state.corners.resize(surface.triangles.size());
  for (std::size_t t = 0; t < state.corners.size(); ++t) {
    const Triangle& triangle = surface.triangles[t];
    state.corners[t] = {surface.positions[triangle[0]], surface.positions[triangle[1]], surface.positions[triangle[2]]};
  }
  const Box box = bounding_box(surface);
  state.centre = box.center();
  const double diagonal = box.diagonal();
  state.scale = diagonal > 0 ? std::ldexp(1.0, -std::ilogb(diagonal)) : 1.0;

  RTCDevice device = state.device.get();
  const Geometry geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER));
  rtcSetGeometryUserPrimitiveCount(geometry.get(), triangle_count());
  rtcSetGeometryUserData(geometry.get(), &state);
  rtcSetGeometryBoundsFunction(geometry.get(), &State::bounds, nullptr);
  rtcCommitGeometry(geometry.get());
  state.scene.reset(rtcNewScene(device));
  rtcAttachGeometry(state.scene.get(), geometry.get());
  rtcCommitScene(state.scene.get());
}

Index ClosestPointTree::triangle_count() const { return static_cast<Index>(state_->corners.size()); }

ClosestPoint ClosestPointTree::closest(const Vec3d& p, Index hint) const {
  assert(triangle_count() > 0 && is_finite(p));
  const State& state = *state_;
  const Vec3f q = state.to_embree(p);
  Query query{.corners = state.corners, .p = p, .scale = state.scale};
  query.margin = kMargin * (1 + std::abs(q.x) + std::abs(q.y) + std::abs(q.z));
  query.best.squared_distance = kInfinity;
  if (hint != kNone) query.improve(hint);

  RTCPointQuery sphere{.x = q.x, .y = q.y, .z = q.z, .time = 0, .radius = query.radius()};
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(state.scene.get(), &sphere, &context, &visit, &query);
  assert(query.best.triangle != kNone);
  return query.best;
}

void ClosestPointTree::closest(std::span<const Vec3d> points, std::span<ClosestPoint> closest_points) const {
  assert(points.size() == closest_points.size());
  parallel_for_ranges(points.size(), 256, [&](std::size_t first, std::size_t end) {
    Index hint = kNone;
    for (std::size_t i = first; i < end; ++i) {
      closest_points[i] = closest(points[i], hint);
      hint = closest_points[i].triangle;
    }
  });
}

}  // namespace limber::eval
