// SPDX-License-Identifier: Apache-2.0
#include "eval/methods/merged_mesh.h"

#include <numeric>

#include "limber/base/triangles.h"

namespace limber::eval {

void find_roots(Index vertex_count, std::span<const FeatureContraction::Merge> merges, std::vector<Index>& roots) {
  roots.resize(vertex_count);
  std::iota(roots.begin(), roots.end(), Index{0});
  // What a vertex was contracted into is known once that has its own.
  for (std::size_t i = merges.size(); i-- > 0;) roots[merges[i].goes] = roots[merges[i].stays];
}

void list_merged(const Mesh& mesh, std::span<const Index> roots, const FeatureContraction& contraction,
                 const Normalization& normalize, std::vector<Index>& place, Approximation& out) {
  list_images(mesh.triangles, roots, out.triangles);
  renumber(out.triangles, mesh.vertex_count, out.nodes, place);
  out.positions.clear();
  for (const Index root : out.nodes)
    out.positions.push_back(normalize.from_unit(static_cast<Vec3d>(contraction.position(root, 0))));
}

}  // namespace limber::eval
