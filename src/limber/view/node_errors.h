// SPDX-License-Identifier: Apache-2.0
// How large the error of each node will seem while it is active: an estimate.
// Part of the player: standard library only.
#pragma once

#include <span>
#include <vector>

#include "limber/base/mesh.h"
#include "limber/stream/frame_state.h"

namespace limber {

// The largest distance below a node is taken to be its root mean squared one, which the stream has, times a peak, which
// begins at kPeak and is learned from what is measured. It counts with the largest weight of a vertex below.
class NodeErrors {
 public:
  static constexpr float kPeak = 2.5f, kHighestPeak = 8;

  explicit NodeErrors(const Hierarchy& hierarchy);

  // Areas are those of the first frame that is estimated: they change slowly, and peaks learn what they do.
  // `weights`: [vertex_count].
  void estimate(const Mesh& mesh, const FrameState& state, std::span<const float> weights);

  // [node_count - vertex_count], node n at n - vertex_count: squares of weighted distances.
  std::span<const float> squares() const { return squares_; }

  // The same places: the largest weight of a finest vertex below.
  std::span<const float> weights() const { return weights_; }

  // The coarse node (its place in squares()) was active, and the square was that.
  void learn(Index place, float square);

 private:
  void measure_areas(const Mesh& mesh, const FrameState& state);

  std::vector<float> vertex_areas_;     // [vertex_count] of the first frame; empty before
  std::vector<float> areas_, weights_;  // [node_count - vertex_count], as all that follow
  std::vector<float> squared_peaks_, squares_;
};

}  // namespace limber
