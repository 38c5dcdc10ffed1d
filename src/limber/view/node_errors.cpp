// SPDX-License-Identifier: Apache-2.0
#include "limber/view/node_errors.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace limber {

namespace {

constexpr float kForget = 0.01f;     // of what a peak has learned, in a frame
constexpr float kMostAtOnce = 2.0f;  // by how much a squared peak grows where it is too low

}  // namespace

NodeErrors::NodeErrors(const Hierarchy& hierarchy) {
  const std::size_t coarse_count = hierarchy.node_count() - hierarchy.vertex_count();
  areas_.resize(coarse_count);
  weights_.resize(coarse_count);
  squared_peaks_.assign(coarse_count, kPeak * kPeak);
  squares_.resize(coarse_count);
}

// A third of each triangle goes to each corner.
void NodeErrors::measure_areas(const Mesh& mesh, const FrameState& state) {
  vertex_areas_.assign(mesh.vertex_count, 0.0f);
  for (const Triangle& t : mesh.triangles) {
    const Vec3f a = state.positions[t[0]];
    const float third = length(cross(state.positions[t[1]] - a, state.positions[t[2]] - a)) / 6;
    for (const Index corner : t) vertex_areas_[corner] += third;
  }
}

void NodeErrors::estimate(const Mesh& mesh, const FrameState& state, std::span<const float> weights) {
  const Hierarchy& hierarchy = state.hierarchy;
  assert(weights.size() == mesh.vertex_count && state.errors.size() == mesh.vertex_count + areas_.size());
  if (areas_.empty()) return;
  if (vertex_areas_.empty()) measure_areas(mesh, state);
  const Index base = hierarchy.vertex_count();
  const Index below_top = hierarchy.level_begin[hierarchy.level_count() - 1] - base;
  const Index* parents = hierarchy.parent.data();
  std::fill(areas_.begin(), areas_.end(), 0.0f);
  std::fill(weights_.begin(), weights_.end(), 0.0f);
  for (Index v = 0; v < base; ++v) {
    const Index parent = parents[v] - base;
    areas_[parent] += vertex_areas_[v];
    weights_[parent] = std::max(weights_[parent], weights[v]);
  }
  for (Index n = 0; n < below_top; ++n) {
    const Index parent = parents[base + n] - base;
    areas_[parent] += areas_[n];
    weights_[parent] = std::max(weights_[parent], weights_[n]);
  }
  const float* errors = state.errors.data() + base;
  for (std::size_t n = 0; n < squares_.size(); ++n) {
    const float seen = errors[n] * weights_[n];
    squared_peaks_[n] += kForget * (kPeak * kPeak - squared_peaks_[n]);
    squares_[n] = seen * seen * squared_peaks_[n] / (areas_[n] + std::numeric_limits<float>::min());
  }
}

void NodeErrors::learn(Index place, float square) {
  if (!(squares_[place] > 0)) return;
  float& peak = squared_peaks_[place];
  const float ratio = std::clamp(square / squares_[place], 1.0f, kMostAtOnce);
  peak = std::min(peak * ratio, std::max(peak, kHighestPeak * kHighestPeak));
  squares_[place] = square;
}

}  // namespace limber
