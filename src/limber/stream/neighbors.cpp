// SPDX-License-Identifier: Apache-2.0
#include "limber/stream/neighbors.h"

#include <cstddef>

namespace limber {

IndexLists incident_triangles(const Mesh& mesh) {
  IndexLists lists;
  lists.begin.assign(std::size_t{mesh.vertex_count} + 1, 0);
  const auto for_each_corner = [&mesh](auto&& visit) {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto [a, b, c] = mesh.triangles[t];
      visit(a, static_cast<Index>(t));
      if (b != a) visit(b, static_cast<Index>(t));
      if (c != a && c != b) visit(c, static_cast<Index>(t));
    }
  };
  for_each_corner([&](Index v, Index) { ++lists.begin[v + 1]; });
  for (std::size_t v = 0; v < mesh.vertex_count; ++v) lists.begin[v + 1] += lists.begin[v];
  lists.data.resize(lists.begin.back());
  std::vector<Index> end(lists.begin.begin(), lists.begin.end() - 1);
  for_each_corner([&](Index v, Index t) { lists.data[end[v]++] = t; });
  return lists;
}

IndexLists neighbors(const Mesh& mesh, const IndexLists& incident) {
  IndexLists lists;
  lists.begin.reserve(std::size_t{mesh.vertex_count} + 1);
  lists.begin.push_back(0);
  std::vector<Index> seen_by(mesh.vertex_count, kNone);
  for (Index v = 0; v < mesh.vertex_count; ++v) {
    seen_by[v] = v;
    for (const Index t : incident[v]) {
      for (const Index u : mesh.triangles[t]) {
        if (seen_by[u] == v) continue;
        seen_by[u] = v;
        lists.data.push_back(u);
      }
    }
    lists.begin.push_back(static_cast<Index>(lists.data.size()));
  }
  lists.data.shrink_to_fit();
  return lists;
}

}  // namespace limber
