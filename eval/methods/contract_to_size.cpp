// SPDX-License-Identifier: Apache-2.0
#include "eval/methods/contract_to_size.h"

#include <algorithm>
#include <cassert>

namespace limber::eval {
namespace {

std::size_t count_triangles(const Contraction& contraction, const Mesh& mesh) {
  std::vector<Index> representative(mesh.vertex_count);
  for (Index v = 0; v < mesh.vertex_count; ++v) representative[v] = contraction.representative(v);
  return static_cast<std::size_t>(std::ranges::count_if(mesh.triangles, [&](const Triangle& t) {
    const Index a = representative[t[0]], b = representative[t[1]], c = representative[t[2]];
    return a != b && b != c && c != a;
  }));
}

}  // namespace

void contract_to_size(Contraction& contraction, const Mesh& mesh, const MethodOptions& options) {
  assert((options.vertices > 0) != (options.triangles > 0));
  if (options.vertices > 0) {
    contraction.contract_to(options.vertices);
    return;
  }
  // A contraction takes away two triangles at most where the surface is manifold: half the excess never goes too far.
  for (;;) {
    const std::size_t count = count_triangles(contraction, mesh);
    if (count <= options.triangles) return;
    const auto excess = static_cast<Index>((count - options.triangles + 1) / 2);
    const Index before = contraction.vertex_count();
    if (contraction.contract_to(before - std::min(excess, before)) == before) return;
  }
}

}  // namespace limber::eval
