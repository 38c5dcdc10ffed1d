// SPDX-License-Identifier: Apache-2.0
#include "limber/view/vertex_errors.h"

#include <cmath>

namespace limber {

void measure_errors(const Mesh& mesh, const FrameState& state, const Cut& cut, std::span<const Index> nodes,
                    VertexErrors& errors) {
  const std::span<const Index> labels = cut.labels();
  errors.area.assign(labels.size(), 0.0);
  for (const Triangle& t : mesh.triangles) {
    const Vec3d a(state.positions[t[0]]), b(state.positions[t[1]]), c(state.positions[t[2]]);
    const double third = length(cross(b - a, c - a)) / 6;
    for (const Index corner : t) errors.area[labels[corner]] += third;
  }
  errors.of_vertex.resize(nodes.size());
  errors.is_counted.assign(labels.size(), 0);
  double squares = 0, area = 0;
  for (std::size_t v = 0; v < nodes.size(); ++v) {
    const double error = double{state.errors[nodes[v]]};
    const double own = errors.area[nodes[v]];
    errors.of_vertex[v] = own > 0 ? static_cast<float>(error / std::sqrt(own)) : 0.0f;
    if (errors.is_counted[nodes[v]]) continue;
    errors.is_counted[nodes[v]] = 1;
    squares += error * error;
    area += own;
  }
  errors.all = area > 0 ? static_cast<float>(std::sqrt(squares / area)) : 0.0f;
}

}  // namespace limber
