// SPDX-License-Identifier: Apache-2.0
#include "limber/clip/sample_body.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace limber {
namespace {

Vec3d stretched(const Limb& limb, const Vec3d& v) {
  return v + limb.flat * (dot(limb.flat, v) * (1.0 / limb.squash - 1.0));
}

}  // namespace

Body::Body(std::span<const Limb> limbs) {
  for (const Limb& limb : limbs) {
    const double radius = std::fmax(limb.radius_a, limb.radius_b);
    if (!(radius > 0.0)) continue;
    Prepared prepared;
    prepared.limb = limb;
    prepared.axis = stretched(limb, limb.b - limb.a);
    const double length2 = squared_length(prepared.axis);
    prepared.inverse_length2 = length2 > 1e-18 ? 1.0 / length2 : 0.0;
    prepared.scale = std::fmin(1.0, limb.squash);
    prepared.center = (limb.a + limb.b) * 0.5;
    prepared.radius = length(limb.b - limb.a) * 0.5 + radius * std::fmax(1.0, limb.squash);
    const Vec3d reach{prepared.radius, prepared.radius, prepared.radius};
    bounds_.add(prepared.center - reach);
    bounds_.add(prepared.center + reach);
    limbs_.push_back(prepared);
  }
}

double Body::evaluate(const Prepared& prepared, const Vec3d& point, Vec3d* gradient) {
  const Limb& limb = prepared.limb;
  const Vec3d p = stretched(limb, point - limb.a);
  const double along = dot(p, prepared.axis) * prepared.inverse_length2;
  const double h = std::clamp(along, 0.0, 1.0);
  const Vec3d away = p - prepared.axis * h;
  const double distance = length(away);
  const double taper = limb.radius_b - limb.radius_a;
  if (gradient != nullptr) {
    Vec3d g = distance > 1e-12 ? away * (1.0 / distance) : Vec3d{0.0, 1.0, 0.0};
    g -= prepared.axis * (prepared.inverse_length2 * taper * 6.0 * h * (1.0 - h));
    *gradient = stretched(limb, g) * prepared.scale;
  }
  return (distance - (limb.radius_a + taper * h * h * (3.0 - 2.0 * h))) * prepared.scale;
}

double Body::distance_to_limb(std::size_t i, const Vec3d& point) const { return evaluate(limbs_[i], point, nullptr); }

BodyValue Body::at(const Vec3d& point) const {
  BodyValue value{.distance = 1e9, .gradient = {0.0, 1.0, 0.0}, .size = 1.0};
  for (const Prepared& prepared : limbs_) {
    // A limb farther than the blend reaches has no influence at all, so leaving it out changes nothing.
    const double reach = (value.distance + prepared.limb.blend) / prepared.scale + prepared.radius;
    if (reach <= 0.0 || squared_length(point - prepared.center) > reach * reach) continue;
    Vec3d gradient;
    const double distance = evaluate(prepared, point, &gradient);
    const double k = prepared.limb.blend;
    const double h = k > 0.0 ? std::fmax(k - std::fabs(distance - value.distance), 0.0) / k : 0.0;
    const double far = h * 0.5;  // the weight of the farther of the two
    const double weight = distance < value.distance ? 1.0 - far : far;
    value.distance = std::fmin(distance, value.distance) - h * h * k * 0.25;
    value.gradient = value.gradient * (1.0 - weight) + gradient * weight;
    value.size = value.size * (1.0 - weight) + prepared.limb.size * weight;
  }
  return value;
}

double BodySurface::distance(const Vec3d& point) const {
  return body.at(point).distance - (relief != nullptr ? relief->height(point) : 0.0);
}

Vec3d BodySurface::project(Vec3d point, int step_count) const {
  for (int step = 0; step < step_count; ++step) {
    const BodyValue value = body.at(point);
    const double distance = value.distance - (relief != nullptr ? relief->height(point) : 0.0);
    const double steepness2 = std::fmax(squared_length(value.gradient), 0.05);
    point -= value.gradient * (distance / steepness2);
    if (std::fabs(distance) < 1e-7) break;
  }
  return point;
}

}  // namespace limber
