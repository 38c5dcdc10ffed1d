// SPDX-License-Identifier: Apache-2.0
// Where methods are worst: the place of the surface, in the whole clip, where each loses most against the first.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "eval/closest_point.h"
#include "eval/report/error_distribution.h"
#include "eval/sample_surface.h"
#include "eval/surface.h"

namespace limber::eval {

struct WorstPlace {
  std::size_t frame = 0;  // counted from 0
  Vec3d point{};          // on the original, in that frame
  Vec3d normal{};         // of the original there; zero where it has none
  double loss = 0;  // the sum, over the samples around the point, of the squared distance minus the first method's
  std::vector<double> rms{};  // [methods]: distance of that neighbourhood, percent of the diagonal
};

// Looks at samples on the original, uniform by area and fixed on it for the whole clip, and at the distance from each
// to every approximation. Samples in the same cell of a grid, a twentieth of the diagonal wide, are a neighbourhood.
class WorstPlaces {
 public:
  // The first method is held against nothing. Precondition: neither number is 0.
  WorstPlaces(std::size_t method_count, std::size_t sample_count, std::uint64_t seed);

  // The next frame. Gives the methods that have been worse in it than ever before. Preconditions: as of
  // ClipMeasure::add(); an approximation per method, each with a triangle.
  std::vector<std::size_t> add(const Surface& original, std::span<const Surface> approximations);

  // Precondition of both: a frame has been added.
  const WorstPlace& of(std::size_t method) const { return *places_[method]; }
  const ErrorDistribution& distribution(std::size_t method) const { return distributions_[method]; }

  std::size_t sample_count() const { return samples_.size(); }

 private:
  std::vector<std::size_t> by_neighborhood(const Vec3d& low, double side) const;

  std::size_t wanted_samples_;
  std::uint64_t seed_;
  std::size_t frame_ = 0;
  std::vector<SurfaceSample> samples_;
  std::vector<ErrorDistribution> distributions_;   // [methods]
  std::vector<std::optional<WorstPlace>> places_;  // [methods]
  ClosestPointTree tree_;
  std::vector<Vec3d> points_;                 // scratch, [samples]
  std::vector<ClosestPoint> closest_;         // scratch, [samples]
  std::vector<std::vector<double>> squared_;  // scratch, [methods][samples]: percent, squared
};

}  // namespace limber::eval
