// SPDX-License-Identifier: Apache-2.0
#include "eval/methods/quadric_error.h"

#include <algorithm>
#include <cassert>

namespace limber::eval {

QuadricError::QuadricError(const Mesh& mesh, const QuadricOptions& options)
    : vertex_count_(mesh.vertex_count),
      vertex_quadrics_(mesh, options),
      unit_(mesh.vertex_count),
      quadrics_(mesh.vertex_count) {}

double QuadricError::measure(std::span<const Vec3f> positions, std::span<const Index> clusters) {
  assert(positions.size() == vertex_count_ && clusters.size() == vertex_count_);
  const Normalization normalize = normalization(positions);
  for (Index v = 0; v < vertex_count_; ++v) unit_[v] = normalize.to_unit(positions[v]);
  vertex_quadrics_.compute(unit_, quadrics_);
  const Index last = clusters.empty() ? 0 : *std::ranges::max_element(clusters);
  sums_.assign(static_cast<std::size_t>(last) + 1, Quadric{});
  for (Index v = 0; v < vertex_count_; ++v) sums_[clusters[v]] += quadrics_[v];
  double total = 0;
  for (const Quadric& sum : sums_) {
    if (sum.xx > 0) total += minimum(sum).value;
  }
  return total;
}

}  // namespace limber::eval
