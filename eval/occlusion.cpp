// SPDX-License-Identifier: Apache-2.0
#include "eval/occlusion.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "eval/finite.h"
#include "eval/parallel_for.h"

namespace limber::eval {
namespace {

constexpr int kMapSize = 448;      // texels along the longer side
constexpr std::size_t kBatch = 8;  // depth maps in memory at once
constexpr float kFar = -std::numeric_limits<float>::infinity();

// Heights towards the light over a plane across it; texel (i, j) holds the greatest height at its centre.
struct DepthMap {
  Vec3f across, along, towards;
  float low_u = 0.0f, low_v = 0.0f, texel = 1.0f;
  int width = 0, height = 0;
  std::vector<float> top;       // [width * height]
  std::vector<Vec3f> in_light;  // [positions] in texels, texels, and heights: scratch
};

void look_along(const Vec3f& towards, DepthMap& map) {
  const Vec3f axis = std::fabs(towards.x) < 0.6f ? Vec3f{1.0f, 0.0f, 0.0f} : Vec3f{0.0f, 1.0f, 0.0f};
  Vec3f across = cross(axis, towards);
  across *= 1.0f / length(across);
  map.towards = towards;
  map.across = across;
  map.along = cross(towards, across);
}

// Two texels stay free on each side, so that filtering needs no test.
void fit(std::span<const Vec3f> positions, DepthMap& map) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  float low_u = kInfinity, high_u = -kInfinity, low_v = kInfinity, high_v = -kInfinity;
  map.in_light.resize(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const Vec3f q{dot(positions[i], map.across), dot(positions[i], map.along), dot(positions[i], map.towards)};
    map.in_light[i] = q;
    low_u = std::min(low_u, q.x), high_u = std::max(high_u, q.x);
    low_v = std::min(low_v, q.y), high_v = std::max(high_v, q.y);
  }
  const float extent = std::max(high_u - low_u, high_v - low_v);
  map.texel = extent > 0.0f ? extent / static_cast<float>(kMapSize - 5) : 1.0f;
  map.low_u = low_u - 2.0f * map.texel;
  map.low_v = low_v - 2.0f * map.texel;
  const auto size = [&](float range) {
    return std::min(kMapSize, static_cast<int>(std::max(0.0f, range) / map.texel) + 5);
  };
  map.width = size(high_u - low_u);
  map.height = size(high_v - low_v);
  const float scale = 1.0f / map.texel;
  for (Vec3f& q : map.in_light) q = {(q.x - map.low_u) * scale, (q.y - map.low_v) * scale, q.z};
  map.top.assign(static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height), kFar);
}

void draw(const Vec3f& p, const Vec3f& q, const Vec3f& r, DepthMap& map) {
  const float area = (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
  if (area == 0.0f) return;
  // Centres in [low, high): coordinates are positive, so that truncation is rounding down.
  const auto first_center = [](float low) { return static_cast<int>(low + 0.5f); };
  const int y0 = first_center(std::min({p.y, q.y, r.y})), y1 = first_center(std::max({p.y, q.y, r.y}));
  const int x0 = first_center(std::min({p.x, q.x, r.x})), x1 = first_center(std::max({p.x, q.x, r.x}));
  if (x0 >= x1 || y0 >= y1 || x1 > map.width || y1 > map.height) return;
  const float slope_x = ((q.z - p.z) * (r.y - p.y) - (r.z - p.z) * (q.y - p.y)) / area;
  const float slope_y = ((r.z - p.z) * (q.x - p.x) - (q.z - p.z) * (r.x - p.x)) / area;
  const Vec3f corners[3] = {p, q, r};
  for (int y = y0; y < y1; ++y) {
    // The span of the row inside all three edges.
    const float center_y = static_cast<float>(y) + 0.5f;
    float left = std::numeric_limits<float>::infinity(), right = -left;
    for (int i = 0; i < 3; ++i) {
      const Vec3f& a = corners[i];
      const Vec3f& b = corners[(i + 1) % 3];
      if ((a.y <= center_y) == (b.y <= center_y)) continue;
      const float x = a.x + (b.x - a.x) * ((center_y - a.y) / (b.y - a.y));
      left = std::min(left, x), right = std::max(right, x);
    }
    if (!(left <= right)) continue;
    const int first = std::max(x0, first_center(left)), end = std::min(x1, first_center(right));
    float* row = map.top.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width);
    const float base = p.z + slope_y * (center_y - p.y);
    for (int x = first; x < end; ++x) {
      row[x] = std::max(row[x], base + slope_x * (static_cast<float>(x) + 0.5f - p.x));
    }
  }
}

void make_map(std::span<const Triangle> triangles, std::span<const Vec3f> positions, const Vec3f& towards,
              DepthMap& map) {
  look_along(towards, map);
  fit(positions, map);
  for (const Triangle& t : triangles) draw(map.in_light[t[0]], map.in_light[t[1]], map.in_light[t[2]], map);
}

// The triangles that hold light back, and only the vertices that they use, which decide what a map covers.
struct Occluders {
  std::vector<Triangle> triangles;
  std::vector<Vec3f> positions;
};

Occluders occluders_of(std::span<const Triangle> triangles, std::span<const Vec3f> positions) {
  Occluders occluders;
  occluders.triangles.reserve(triangles.size());
  std::vector<Index> place(positions.size(), kNone);
  for (const Triangle& t : triangles) {
    if (!has_finite_corners(t, positions)) continue;
    Triangle placed;
    for (std::size_t k = 0; k < 3; ++k) {
      Index& index = place[t[k]];
      if (index == kNone) {
        index = static_cast<Index>(occluders.positions.size());
        occluders.positions.push_back(positions[t[k]]);
      }
      placed[k] = index;
    }
    occluders.triangles.push_back(placed);
  }
  return occluders;
}

// The share of light at a receiver, filtered over the four nearest texels. A receiver is lifted off its own triangle
// along the normal, and compared with a tolerance that grows with the slope of the triangle seen from the light.
float open_share(const DepthMap& map, const Receiver& receiver, float cosine) {
  const Vec3f p = receiver.point + receiver.facing * (1.2f * map.texel);
  const float scale = 1.0f / map.texel;
  const float u = (dot(p, map.across) - map.low_u) * scale - 0.5f;
  const float v = (dot(p, map.along) - map.low_v) * scale - 0.5f;
  if (!(u >= 0.0f && v >= 0.0f && u < static_cast<float>(map.width - 1) && v < static_cast<float>(map.height - 1))) {
    return 1.0f;
  }
  const float bias = map.texel * std::min(3.0f, 0.4f / std::max(cosine, 0.05f));
  const float height = dot(p, map.towards) + bias;
  const int i = static_cast<int>(u), j = static_cast<int>(v);
  const float* t = map.top.data() + static_cast<std::size_t>(j) * static_cast<std::size_t>(map.width) + i;
  const float fu = u - static_cast<float>(i), fv = v - static_cast<float>(j);
  // Products rather than choices: the outcome of the comparisons cannot be predicted.
  const auto lit = [height](float top) { return static_cast<float>(top <= height); };
  const float near_row = lit(t[0]) * (1.0f - fu) + lit(t[1]) * fu;
  const float far_row = lit(t[map.width]) * (1.0f - fu) + lit(t[map.width + 1]) * fu;
  return near_row * (1.0f - fv) + far_row * fv;
}

// Sums over the lights so far.
struct Sums {
  float sky = 0.0f, sky_all = 0.0f, key = 0.0f, key_all = 0.0f;
};

void add_light(const DepthMap& map, const DirectionalLight& light, const Receiver& receiver, Sums& sums) {
  const float shaded = dot(receiver.normal, light.towards);
  const float flat = dot(receiver.facing, light.towards);
  const float sky = light.sky * std::max(0.0f, shaded);
  if (sky <= 0.0f && light.key <= 0.0f) return;
  sums.sky_all += sky;
  sums.key_all += light.key;
  // Behind the flat triangle but before the smooth normal: the facets of a coarse mesh must not show as shadow.
  const float open = shaded <= 0.0f ? 0.0f : open_share(map, receiver, flat);
  sums.sky += sky * open;
  sums.key += light.key * open;
}

}  // namespace

std::vector<Reached> reached_light(std::span<const Triangle> triangles, std::span<const Vec3f> positions,
                                   std::span<const DirectionalLight> lights, std::span<const Receiver> receivers) {
  const Occluders occluders = occluders_of(triangles, positions);
  if (occluders.triangles.empty()) return std::vector<Reached>(receivers.size());
  std::vector<Sums> sums(receivers.size());
  std::vector<DepthMap> maps(std::min(kBatch, lights.size()));
  for (std::size_t first = 0; first < lights.size(); first += kBatch) {
    const std::size_t count = std::min(kBatch, lights.size() - first);
    parallel_for(count, [&](std::size_t k) {
      make_map(occluders.triangles, occluders.positions, lights[first + k].towards, maps[k]);
    });
    // Every receiver adds its lights in the same order on any number of threads.
    parallel_for_ranges(receivers.size(), 2048, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = 0; k < count; ++k) {
        for (std::size_t i = begin; i < end; ++i) add_light(maps[k], lights[first + k], receivers[i], sums[i]);
      }
    });
  }
  std::vector<Reached> reached(receivers.size());
  for (std::size_t i = 0; i < receivers.size(); ++i) {
    if (sums[i].sky_all > 0.0f) reached[i].sky = sums[i].sky / sums[i].sky_all;
    if (sums[i].key_all > 0.0f) reached[i].key = sums[i].key / sums[i].key_all;
  }
  return reached;
}

std::vector<Vec3f> sphere_directions(int count) {
  // A Fibonacci spiral: equal steps in height, turned by the golden angle each.
  constexpr double kGoldenCosine = -0.73736887807831985597, kGoldenSine = 0.67549029426152364180;
  std::vector<Vec3f> directions;
  double cosine = 1.0, sine = 0.0;
  for (int i = 0; i < count; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / count;
    const double r = std::sqrt(1.0 - z * z);
    directions.push_back(Vec3f(Vec3d{r * cosine, r * sine, z}));
    const double next = cosine * kGoldenCosine - sine * kGoldenSine;
    sine = cosine * kGoldenSine + sine * kGoldenCosine;
    cosine = next;
  }
  return directions;
}

}  // namespace limber::eval
