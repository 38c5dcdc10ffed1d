// SPDX-License-Identifier: Apache-2.0
#include "eval/shade.h"

#include <algorithm>
#include <cmath>

namespace limber::eval {
namespace {

constexpr int kSkyCount = 96;
constexpr int kKeyCount = 14;
constexpr float kKeySpread = 0.13f;  // radius of the key light, as a tangent

// From 0 below the horizon to 1 above it.
float height_in_sky(const Vec3f& v, const Vec3f& up) { return 0.5f + 0.5f * dot(v, up); }

// Leaves the dark half alone and brings what is brighter smoothly below 1.
float soften_highlights(float x) {
  constexpr float kKnee = 0.72f;
  if (x <= kKnee) return x;
  const float over = (x - kKnee) / (1.0f - kKnee);
  return kKnee + (1.0f - kKnee) * over / (1.0f + over);
}

}  // namespace

Vec3f unit_or(const Vec3f& v, const Vec3f& otherwise) {
  const float square = squared_length(v);
  return square > 0.0f && std::isfinite(square) ? v * (1.0f / std::sqrt(square)) : otherwise;
}

Vec3f normal_before_eye(const Vec3f& normal, const Vec3f& to_eye) {
  constexpr float kLeast = 0.04f;
  const float towards = dot(normal, to_eye);
  if (towards >= kLeast) return normal;
  return unit_or(normal + to_eye * (kLeast - towards), to_eye);
}

Studio make_studio(const CameraAxes& axes, const Vec3d& world_up) {
  Studio studio;
  const Vec3f right(axes.right), back(axes.back);
  studio.up = unit_or(Vec3f(world_up), Vec3f(axes.up));
  // The key keeps to the camera's upper left, and above the ground whatever the camera looks at.
  studio.key = unit_or(right * -0.52f + Vec3f(axes.up) * 0.45f + studio.up * 0.45f + back * 0.62f, back);
  studio.fill = unit_or(right * 0.85f + Vec3f(axes.up) * 0.10f + back * 0.50f, back);

  for (const Vec3f& d : sphere_directions(kSkyCount)) {
    if (dot(d, back) < -0.6f) continue;
    // Directions away from the camera weigh less, so that hollows that face it stay open.
    const float sky = (0.22f + 0.78f * height_in_sky(d, studio.up)) * (0.45f + 0.55f * height_in_sky(d, back));
    studio.lights.push_back({d, sky, 0.0f});
  }
  const Vec3f across = unit_or(cross(studio.key, back), right);
  const Vec3f along = cross(studio.key, across);
  const std::vector<Vec3f> disc = sphere_directions(2 * kKeyCount);
  for (int i = 0; i < kKeyCount; ++i) {
    // The upper half of the sphere, seen from above, is a disc; its outer part is denser, which makes soft edges.
    const Vec3f& d = disc[static_cast<std::size_t>(i)];
    studio.lights.push_back({unit_or(studio.key + (across * d.x + along * d.y) * kKeySpread, studio.key), 0.0f, 1.0f});
  }
  return studio;
}

Vec3f shade(const Studio& studio, const Surfel& s) {
  const Vec3f& n = s.normal;
  const float sky_share = s.reached.sky;
  const float key_cosine = dot(n, studio.key);
  // The key is large: its light reaches a little round the edge.
  const float key = std::max(0.0f, (key_cosine + 0.12f) * (1.0f / 1.12f)) * s.reached.key;
  const float fill = std::max(0.0f, dot(n, studio.fill)) * (0.35f + 0.65f * sky_share);
  const float up = height_in_sky(n, studio.up);
  const float facing = std::clamp(dot(n, s.to_eye), 0.0f, 1.0f);
  const float edge = (1.0f - facing) * (1.0f - facing) * (1.0f - facing);

  // Light that is reflected again inside hollows keeps bright materials from turning grey there.
  const float luminance = 0.2126f * s.albedo.x + 0.7152f * s.albedo.y + 0.0722f * s.albedo.z;
  const float open = sky_share / std::max(1e-3f, 1.0f - 0.45f * luminance * (1.0f - sky_share));

  if (s.data) {
    const float light = 0.56f * key + 0.14f * fill + open * (0.42f + 0.26f * up);
    const float level = light * (1.0f - 0.30f * edge);
    return {std::min(1.0f, s.albedo.x * level), std::min(1.0f, s.albedo.y * level), std::min(1.0f, s.albedo.z * level)};
  }

  const Vec3f key_color{1.00f, 0.965f, 0.91f}, fill_color{0.86f, 0.93f, 1.00f};
  const Vec3f sky_color{0.94f, 0.97f, 1.00f}, ground_color{0.62f, 0.58f, 0.54f};
  const Vec3f sky = (sky_color * up + ground_color * (1.0f - up)) * (0.44f * open);
  const Vec3f light = key_color * (1.10f * key) + fill_color * (0.16f * fill) + sky;

  const Vec3f half = unit_or(studio.key + s.to_eye, s.to_eye);
  float lobe = std::max(0.0f, dot(n, half));
  for (int doubling = 0; doubling < 4; ++doubling) lobe *= lobe;
  const float wide = lobe;  // exponent 16
  lobe *= lobe, lobe *= lobe;
  const float shine = (0.035f * wide + 0.06f * lobe) * s.reached.key * (key_cosine > 0.0f ? 1.0f : 0.0f);
  const float rim = 0.10f * edge * up * sky_share;

  const float level = 1.0f - 0.42f * edge;
  const auto channel = [&](float albedo, float lit) {
    return soften_highlights(albedo * lit * level + shine + rim * albedo);
  };
  return {channel(s.albedo.x, light.x), channel(s.albedo.y, light.y), channel(s.albedo.z, light.z)};
}

}  // namespace limber::eval
