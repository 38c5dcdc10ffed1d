// SPDX-License-Identifier: Apache-2.0
// What tells surfaces apart, counted from scratch with maps and sets: slow, and independent of the library.
#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "limber/base/mesh.h"

namespace limber::test {

struct Invariants {
  long vertex_count = 0;  // with a triangle
  long euler_characteristic = 0;
  long component_count = 0;
  long border_loop_count = 0;
  bool is_manifold = true;  // no triangle is there twice, every edge has one or two, every vertex is regular
  bool is_oriented = true;  // no edge is passed twice in the same direction

  friend bool operator==(const Invariants&, const Invariants&) = default;
};

// Labels of the sets that the pairs join, by items.
inline std::map<Index, Index> joined(const std::set<Index>& items, const std::vector<std::pair<Index, Index>>& pairs) {
  std::map<Index, Index> label;
  for (const Index i : items) label[i] = i;
  const auto root = [&](Index i) {
    while (label.at(i) != i) i = label[i] = label.at(label.at(i));
    return i;
  };
  for (const auto& [a, b] : pairs) label[root(a)] = root(b);
  for (const Index i : items) label[i] = root(i);
  return label;
}

inline long set_count(const std::map<Index, Index>& label) {
  return std::count_if(label.begin(), label.end(), [](const auto& item) { return item.first == item.second; });
}

// Whether triangles, given by their edges across from a vertex, form one fan around it.
inline bool is_fan(const std::vector<std::pair<Index, Index>>& across) {
  std::set<Index> around;
  std::map<Index, int> use;
  for (const auto& [q, r] : across) around.insert({q, r}), ++use[q], ++use[r];
  for (const auto& [v, count] : use)
    if (count > 2) return false;
  return set_count(joined(around, across)) == 1 && (around.size() >= 3 || across.size() == 1);
}

// [vertex_count]: whether the triangles of a vertex form one fan; not if it has none.
inline std::vector<bool> regular_vertices(Index vertex_count, const std::vector<Triangle>& triangles) {
  std::vector<std::vector<std::pair<Index, Index>>> across(vertex_count);
  for (const auto& [a, b, c] : triangles) {
    if (a == b || b == c || c == a) continue;
    across[a].push_back({b, c}), across[b].push_back({c, a}), across[c].push_back({a, b});
  }
  std::vector<bool> regular(vertex_count);
  for (Index v = 0; v < vertex_count; ++v) regular[v] = !across[v].empty() && is_fan(across[v]);
  return regular;
}

// Triangles with a repeated corner are left out.
inline Invariants invariants_of(const std::vector<Triangle>& triangles) {
  Invariants out;
  std::set<Index> vertices, border_vertices;
  std::map<std::pair<Index, Index>, int> edge_use, directed_use;
  std::map<Index, std::vector<std::pair<Index, Index>>> across;
  std::set<std::array<Index, 3>> different;
  long triangle_count = 0;
  for (const auto& [a, b, c] : triangles) {
    if (a == b || b == c || c == a) continue;
    ++triangle_count;
    std::array<Index, 3> corners = {a, b, c};
    std::sort(corners.begin(), corners.end());
    out.is_manifold &= different.insert(corners).second;
    for (const auto& [p, q, r] : {Triangle{a, b, c}, {b, c, a}, {c, a, b}}) {
      vertices.insert(p);
      ++edge_use[std::minmax(p, q)];
      out.is_oriented &= ++directed_use[{p, q}] == 1;
      across[p].push_back({q, r});
    }
  }
  std::vector<std::pair<Index, Index>> edges, border;
  for (const auto& [ends, use] : edge_use) {
    edges.push_back(ends);
    if (use == 1) border.push_back(ends), border_vertices.insert({ends.first, ends.second});
    out.is_manifold &= use <= 2;
  }
  for (const auto& [v, edges_across] : across) out.is_manifold &= is_fan(edges_across);
  out.vertex_count = static_cast<long>(vertices.size());
  out.euler_characteristic = out.vertex_count - static_cast<long>(edges.size()) + triangle_count;
  out.component_count = set_count(joined(vertices, edges));
  out.border_loop_count = set_count(joined(border_vertices, border));
  return out;
}

// Whether two surfaces can be deformed into each other, vertex counts aside.
inline bool same_shape(Invariants a, Invariants b) {
  a.vertex_count = b.vertex_count = 0;
  return a == b;
}

// What a hierarchy or a contraction makes of triangles: `image` for every corner.
inline std::vector<Triangle> mapped(std::vector<Triangle> triangles, const std::vector<Index>& image) {
  for (Triangle& t : triangles)
    for (Index& corner : t) corner = image[corner];
  return triangles;
}

}  // namespace limber::test
