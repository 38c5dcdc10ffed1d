// SPDX-License-Identifier: Apache-2.0
// Points on a surface: uniform by area, or as Metro (Cignoni, Rocchini & Scopigno 1998) takes them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "eval/surface.h"

namespace limber::eval {

// How many samples a measure takes on a surface: as many per triangle on average, and so many at least.
struct SampleOptions {
  std::size_t per_triangle = 10;
  std::size_t at_least = 100'000;
  std::uint64_t seed = 1;

  // At least 1.
  std::size_t total(std::size_t triangle_count) const;
};

struct SurfaceSample {
  Index triangle = kNone;
  std::array<double, 3> barycentric{};  // at least 0, sum 1
};

// Samples uniform by area, fewer than a sample away from each triangle's exact share, evenly spread inside the
// triangle. Sample i depends on the surface, the total, the seed and i only, and the samples of a triangle follow each
// other, so that the list can be made piece by piece and in parallel. Because the samples are barycentric, they can
// be followed through the frames of a clip.
class AreaSamples {
 public:
  // Places `total` samples. A surface without area gets the same number on each triangle. Precondition: the surface
  // has a triangle.
  AreaSamples(const Surface& surface, std::size_t total, std::uint64_t seed);

  std::size_t size() const { return starts_.back(); }

  // The samples first, first + 1, ... Precondition: first + out.size() <= size().
  void fill(std::size_t first, std::span<SurfaceSample> out) const;

 private:
  std::vector<std::size_t> starts_;  // [triangle_count + 1]: the first sample of each triangle
  std::uint64_t seed_;
};

// As Metro's default: every vertex that a triangle uses, points along every edge, and what is then left of `total` on
// the faces. Near vertices and edges, where an approximation is usually worst, such samples are denser than uniform;
// the measure is therefore larger, most of all where triangle sizes vary. For comparison with published values only.
std::vector<SurfaceSample> sample_like_metro(const Surface& surface, std::size_t total, std::uint64_t seed);

}  // namespace limber::eval
