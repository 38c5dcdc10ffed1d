// SPDX-License-Identifier: Apache-2.0
#include "limber/contract/edges.h"

namespace limber {

Edges find_edges(const Mesh& mesh) {
  // Half-edges bucketed by their smaller end; within a bucket, `slot` finds the edge of a larger end.
  struct HalfEdge {
    Index larger, triangle;
  };
  std::vector<Index> begin(mesh.vertex_count + 1, 0);
  const auto for_each = [&](auto&& visit) {
    for (Index f = 0; f < mesh.triangles.size(); ++f) {
      const Triangle& t = mesh.triangles[f];
      if (is_degenerate(t)) continue;
      for (int i = 0; i < 3; ++i) {
        const Index p = t[static_cast<std::size_t>(i)], q = t[static_cast<std::size_t>((i + 1) % 3)];
        p < q ? visit(p, q, f) : visit(q, p, f);
      }
    }
  };
  for_each([&](Index smaller, Index, Index) { ++begin[smaller + 1]; });
  for (Index v = 0; v < mesh.vertex_count; ++v) begin[v + 1] += begin[v];
  std::vector<HalfEdge> half_edges(begin.back());
  std::vector<Index> next(begin.begin(), begin.end() - 1);
  for_each([&](Index smaller, Index larger, Index f) { half_edges[next[smaller]++] = {larger, f}; });

  Edges edges;
  edges.ends.reserve(half_edges.size() / 2 + 16);
  edges.triangle_count.reserve(half_edges.size() / 2 + 16);
  edges.some_triangle.reserve(half_edges.size() / 2 + 16);
  std::vector<Index> slot(mesh.vertex_count, kNone);
  for (Index v = 0; v < mesh.vertex_count; ++v) {
    const auto first_edge = static_cast<Index>(edges.ends.size());
    for (Index h = begin[v]; h < begin[v + 1]; ++h) {
      const auto [larger, triangle] = half_edges[h];
      Index& edge = slot[larger];
      if (edge == kNone || edge < first_edge) {
        edge = static_cast<Index>(edges.ends.size());
        edges.ends.push_back({v, larger});
        edges.triangle_count.push_back(0);
        edges.some_triangle.push_back(triangle);
      }
      ++edges.triangle_count[edge];
    }
  }
  return edges;
}

}  // namespace limber
