// SPDX-License-Identifier: Apache-2.0
#include "eval/methods/merged_mesh.h"

#include <numeric>

namespace limber::eval {

void find_roots(Index vertex_count, std::span<const FeatureContraction::Merge> merges, std::vector<Index>& roots) {
  roots.resize(vertex_count);
  std::iota(roots.begin(), roots.end(), Index{0});
  // What a vertex was contracted into is known once that has its own.
  for (std::size_t i = merges.size(); i-- > 0;) roots[merges[i].goes] = roots[merges[i].stays];
}

void list_merged(const Mesh& mesh, std::span<const Index> roots, const FeatureContraction& contraction,
                 const Normalization& normalize, std::vector<Index>& place, Approximation& out) {
  out.triangles.clear();
  out.positions.clear();
  out.nodes.clear();
  place.assign(mesh.vertex_count, kNone);
  for (const Triangle& t : mesh.triangles) {
    Triangle image{roots[t[0]], roots[t[1]], roots[t[2]]};
    if (is_degenerate(image)) continue;
    for (Index& corner : image) {
      Index& at = place[corner];
      if (at == kNone) {
        at = static_cast<Index>(out.positions.size());
        out.positions.push_back(normalize.from_unit(static_cast<Vec3d>(contraction.position(corner, 0))));
        out.nodes.push_back(corner);
      }
      corner = at;
    }
    out.triangles.push_back(image);
  }
}

}  // namespace limber::eval
