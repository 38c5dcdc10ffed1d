// SPDX-License-Identifier: Apache-2.0
// How far an approximation is from its original: surface distance by sampling, in both directions
// (Cignoni, Rocchini & Scopigno, Metro, 1998), with samples uniform by area.
#pragma once

#include <cstddef>

#include "eval/closest_point.h"
#include "eval/sample_surface.h"
#include "eval/surface.h"

namespace limber::eval {

enum class Sampling {
  kArea,   // uniform by area: the measure of limber
  kMetro,  // vertices, edges and faces as Metro's default: larger values, for comparison with published ones
};

struct DistanceOptions {
  SampleOptions samples{};
  Sampling sampling = Sampling::kArea;
};

// Distances from the points of one surface to the closest points of the other, in percent of the diagonal of the
// original's bounding box.
struct OneWayDistance {
  double rms = 0;
  double mean = 0;
  double max = 0;                // over the vertices, the samples, and uphill from the highest samples
  double rms_error = 0;          // standard error of `rms` from sampling
  std::size_t sample_count = 0;  // in rms and mean; the vertices, which count towards max, are not among them
};

struct Distance {
  double rms = 0;  // rms, mean, max: the larger of the two directions
  double mean = 0;
  double max = 0;
  double rms_error = 0;             // of the direction that gave rms
  OneWayDistance to_approximation;  // from the original's points
  OneWayDistance to_original;       // from the approximation's points
  double diagonal = 0;              // of the original's bounding box, in the units of the positions
};

// Preconditions: both surfaces have a triangle; the original's bounding box is not a point. Isolated vertices count
// for nothing. The values do not depend on the number of threads, and are the same for surfaces scaled or moved
// together as far as their single-precision positions are.
Distance measure_distance(const Surface& original, const Surface& approximation, const DistanceOptions& options = {});

// The same, where trees of the two surfaces exist already.
Distance measure_distance(const Surface& original, const ClosestPointTree& original_tree, const Surface& approximation,
                          const ClosestPointTree& approximation_tree, const DistanceOptions& options = {});

}  // namespace limber::eval
