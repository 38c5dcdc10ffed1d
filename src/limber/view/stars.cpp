// SPDX-License-Identifier: Apache-2.0
#include "limber/view/stars.h"

namespace limber {

Stars::Stars(const Mesh& mesh) : begin_(mesh.vertex_count + std::size_t{1}, 0) {
  for (const Triangle& t : mesh.triangles) {
    if (is_degenerate(t)) continue;
    for (const Index corner : t) ++begin_[corner + 1];
  }
  for (Index v = 0; v < mesh.vertex_count; ++v) begin_[v + 1] += begin_[v];
  faces_.resize(begin_.back());
  std::vector<Index> next(begin_);
  for (Index face = 0; face < mesh.triangles.size(); ++face) {
    if (is_degenerate(mesh.triangles[face])) continue;
    for (const Index corner : mesh.triangles[face]) faces_[next[corner]++] = face;
  }
}

}  // namespace limber
