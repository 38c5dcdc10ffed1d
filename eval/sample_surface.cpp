// SPDX-License-Identifier: Apache-2.0
// Area-uniform samples. The triangles' areas are laid end to end on a line, and the line is cut at equal steps from a
// seeded start: triangle t gets as many samples as cuts fall on it (systematic sampling). Inside a triangle the samples
// are the points of Roberts' R2 sequence, shifted by a hash of the seed and the triangle, folded from the unit square
// onto the triangle. Every point of the surface is equally likely, and the samples repel each other.
//
// Metro-like samples: vertices; then edges, at the square root of the samples per area still to be placed; then faces.
#include "eval/sample_surface.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace limber::eval {
namespace {

// The mixing function of splitmix64 (Steele, Lea & Flood 2014).
std::uint64_t mix(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

// In [0, 1).
double unit(std::uint64_t bits) { return static_cast<double>(bits >> 11) * 0x1p-53; }

double fraction(double x) { return x - std::floor(x); }

// 1/g and 1/g^2 with g the plastic number, g^3 = g + 1.
constexpr double kStepU = 0.75487766624669276;
constexpr double kStepV = 0.56984029099805327;

// The points of one triangle.
class TrianglePoints {
 public:
  TrianglePoints(std::uint64_t seed, std::size_t triangle)
      : hash_(mix(seed ^ mix(triangle))), u_(unit(hash_)), v_(unit(mix(hash_))) {}

  std::array<double, 3> operator[](std::size_t i) const {
    double u = fraction(u_ + static_cast<double>(i) * kStepU);
    double v = fraction(v_ + static_cast<double>(i) * kStepV);
    if (u + v > 1) u = 1 - u, v = 1 - v;
    return {std::max(0.0, 1 - u - v), u, v};
  }

 private:
  std::uint64_t hash_;
  double u_, v_;
};

// Cuts lengths laid end to end into `total` equal steps from a seeded start; gives the first cut of each length, and
// the number of cuts at the end.
std::vector<std::size_t> share_out(std::vector<double> lengths, std::size_t total, std::uint64_t seed) {
  double sum = 0;
  for (const double length : lengths) sum += length;
  if (!(sum > 0)) {
    std::fill(lengths.begin(), lengths.end(), 1.0);
    sum = static_cast<double>(lengths.size());
  }
  const double start = unit(mix(seed));
  std::vector<std::size_t> firsts(lengths.size() + 1, 0);
  double before = 0;
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    before += lengths[i];
    const double cuts = before / sum * static_cast<double>(total) + start;
    firsts[i + 1] = std::clamp(static_cast<std::size_t>(cuts), firsts[i], total);
  }
  firsts.back() = total;
  return firsts;
}

std::vector<double> areas_of(const Surface& surface) {
  std::vector<double> areas(surface.triangles.size());
  for (std::size_t t = 0; t < areas.size(); ++t) areas[t] = length(area_vector(surface, t)) / 2;
  return areas;
}

// An edge, and the first triangle that has it, as that triangle's side from `corner` to the next.
struct Edge {
  Index low, high, triangle, corner;

  friend bool operator<(const Edge& a, const Edge& b) {
    return std::pair(a.low, a.high) < std::pair(b.low, b.high) ||
           (std::pair(a.low, a.high) == std::pair(b.low, b.high) && a.triangle < b.triangle);
  }
};

std::vector<Edge> edges_of(const Surface& surface) {
  std::vector<Edge> edges;
  edges.reserve(surface.triangles.size() * 3);
  for (Index t = 0; t < surface.triangles.size(); ++t) {
    for (Index k = 0; k < 3; ++k) {
      const Index from = surface.triangles[t][k], to = surface.triangles[t][(k + 1) % 3];
      edges.push_back({std::min(from, to), std::max(from, to), t, k});
    }
  }
  std::sort(edges.begin(), edges.end());
  const auto same = [](const Edge& a, const Edge& b) { return a.low == b.low && a.high == b.high; };
  edges.erase(std::unique(edges.begin(), edges.end(), same), edges.end());
  return edges;
}

void add_vertices(const Surface& surface, std::vector<SurfaceSample>& samples) {
  std::vector<bool> seen(surface.positions.size(), false);
  for (Index t = 0; t < surface.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Index vertex = surface.triangles[t][k];
      if (seen[vertex]) continue;
      seen[vertex] = true;
      SurfaceSample sample{t, {}};
      sample.barycentric[k] = 1;
      samples.push_back(sample);
    }
  }
}

void add_edges(const Surface& surface, double per_length, std::uint64_t seed, std::vector<SurfaceSample>& samples) {
  const std::vector<Edge> edges = edges_of(surface);
  std::vector<double> lengths(edges.size());
  double sum = 0;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const Surface& s = surface;
    lengths[e] = length(Vec3d(s.positions[edges[e].high]) - Vec3d(s.positions[edges[e].low]));
    sum += lengths[e];
  }
  const std::vector<std::size_t> firsts = share_out(lengths, static_cast<std::size_t>(sum * per_length), seed);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const std::size_t count = firsts[e + 1] - firsts[e];
    for (std::size_t i = 0; i < count; ++i) {
      const double along = static_cast<double>(i + 1) / static_cast<double>(count + 1);
      SurfaceSample sample{edges[e].triangle, {}};
      sample.barycentric[edges[e].corner] = 1 - along;
      sample.barycentric[(edges[e].corner + 1) % 3] = along;
      samples.push_back(sample);
    }
  }
}

// The inner points of a lattice on each triangle, as fine as its share allows; what one triangle's lattice cannot take
// goes to the next.
void add_faces(const Surface& surface, double per_area, std::vector<SurfaceSample>& samples) {
  double share = 0;
  for (Index t = 0; t < surface.triangles.size(); ++t) {
    share += length(area_vector(surface, t)) / 2 * per_area;
    if (share < 1) continue;
    // A lattice with m steps to a side has (m - 1)(m - 2) / 2 inner points.
    const auto m = static_cast<std::size_t>((std::sqrt(1 + 8 * std::floor(share)) + 3) / 2);
    for (std::size_t i = 1; i + 1 < m; ++i) {
      for (std::size_t j = 1; i + j < m; ++j) {
        const double u = static_cast<double>(i) / static_cast<double>(m);
        const double v = static_cast<double>(j) / static_cast<double>(m);
        samples.push_back({t, {static_cast<double>(m - i - j) / static_cast<double>(m), u, v}});
      }
    }
    share -= static_cast<double>((m - 1) * (m - 2) / 2);
  }
}

}  // namespace

std::size_t SampleOptions::total(std::size_t triangle_count) const {
  return std::max({at_least, per_triangle * triangle_count, std::size_t{1}});
}

AreaSamples::AreaSamples(const Surface& surface, std::size_t total, std::uint64_t seed)
    : starts_(share_out(areas_of(surface), total, seed)), seed_(seed) {
  assert(!surface.triangles.empty());
}

void AreaSamples::fill(std::size_t first, std::span<SurfaceSample> out) const {
  assert(first + out.size() <= size());
  if (out.empty()) return;
  auto t = static_cast<std::size_t>(std::upper_bound(starts_.begin(), starts_.end(), first) - starts_.begin()) - 1;
  for (std::size_t i = 0; i < out.size(); ++t) {
    const TrianglePoints points(seed_, t);
    for (; i < out.size() && first + i < starts_[t + 1]; ++i) {
      out[i] = {static_cast<Index>(t), points[first + i - starts_[t]]};
    }
  }
}

std::vector<SurfaceSample> sample_like_metro(const Surface& surface, std::size_t total, std::uint64_t seed) {
  double area = 0;
  for (const double a : areas_of(surface)) area += a;

  std::vector<SurfaceSample> samples;
  add_vertices(surface, samples);
  if (samples.size() >= total || !(area > 0)) return samples;
  const std::size_t beside_vertices = total - samples.size();
  add_edges(surface, std::sqrt(static_cast<double>(beside_vertices) / area), seed, samples);
  // Metro takes the vertices off its total a second time here.
  if (samples.size() >= beside_vertices) return samples;
  add_faces(surface, static_cast<double>(beside_vertices - samples.size()) / area, samples);
  return samples;
}

}  // namespace limber::eval
