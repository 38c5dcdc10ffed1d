// SPDX-License-Identifier: Apache-2.0
#include "limber/contract/orientation.h"

#include <array>
#include <utility>
#include <vector>

namespace limber {
namespace {

// By triangle and edge, the edge k being that from corner k to the next: the triangle beyond it, kNone where there is
// none or more than one.
using Neighbours = std::vector<std::array<Index, 3>>;

struct HalfEdge {
  Index larger, triangle;  // the larger of its ends
  std::uint32_t edge;      // of the triangle
};

Neighbours find_neighbours(const Mesh& mesh) {
  const auto for_each = [&](auto&& visit) {
    for (Index t = 0; t < mesh.triangles.size(); ++t) {
      const Triangle& corners = mesh.triangles[t];
      if (is_degenerate(corners)) continue;
      for (std::uint32_t k = 0; k < 3; ++k) {
        const Index p = corners[k], q = corners[(k + 1) % 3];
        p < q ? visit(p, HalfEdge{q, t, k}) : visit(q, HalfEdge{p, t, k});
      }
    }
  };
  std::vector<Index> begin(mesh.vertex_count + std::size_t{1}, 0);
  for_each([&](Index smaller, const HalfEdge&) { ++begin[smaller + 1]; });
  for (Index v = 0; v < mesh.vertex_count; ++v) begin[v + 1] += begin[v];
  std::vector<HalfEdge> half_edges(begin.back());
  std::vector<Index> next(begin.begin(), begin.end() - 1);
  for_each([&](Index smaller, const HalfEdge& half) { half_edges[next[smaller]++] = half; });

  Neighbours neighbours(mesh.triangles.size(), {kNone, kNone, kNone});
  struct Met {
    Index smaller = kNone, triangle_count = 0, first = 0, second = 0;
  };
  std::vector<Met> met(mesh.vertex_count);  // by larger end
  for (Index v = 0; v < mesh.vertex_count; ++v) {
    for (Index h = begin[v]; h < begin[v + 1]; ++h) {
      Met& edge = met[half_edges[h].larger];
      if (edge.smaller != v) edge = {v, 0, h, h};
      ++edge.triangle_count;
      edge.second = h;
    }
    for (Index h = begin[v]; h < begin[v + 1]; ++h) {
      const Met& edge = met[half_edges[h].larger];
      const Index beyond = h == edge.first ? edge.second : edge.first;
      if (edge.triangle_count == 2)
        neighbours[half_edges[h].triangle][half_edges[h].edge] = half_edges[beyond].triangle;
    }
  }
  return neighbours;
}

bool passes(const Triangle& t, Index from, Index to) {
  return (t[0] == from && t[1] == to) || (t[1] == from && t[2] == to) || (t[2] == from && t[0] == to);
}

}  // namespace

void orient_alike(Mesh& mesh) {
  const Neighbours neighbours = find_neighbours(mesh);
  const std::vector<Triangle> given = mesh.triangles;
  std::vector<bool> reached(mesh.triangles.size(), false);
  std::vector<Index> ahead;
  for (Index first = 0; first < mesh.triangles.size(); ++first) {
    if (reached[first]) continue;
    reached[first] = true;
    ahead.push_back(first);
    while (!ahead.empty()) {
      const Index t = ahead.back();
      ahead.pop_back();
      for (std::size_t k = 0; k < 3; ++k) {
        const Index beyond = neighbours[t][k];
        if (beyond == kNone || reached[beyond]) continue;
        reached[beyond] = true;
        const Index p = given[t][k], q = given[t][(k + 1) % 3];
        Triangle& other = mesh.triangles[beyond];
        if (passes(mesh.triangles[t], p, q) == passes(other, p, q)) std::swap(other[1], other[2]);
        ahead.push_back(beyond);
      }
    }
  }
}

}  // namespace limber
