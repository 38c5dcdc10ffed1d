// SPDX-License-Identifier: Apache-2.0
#include "limber/contract/surface.h"

#include <algorithm>
#include <cassert>

#include "limber/contract/edges.h"

namespace limber {
namespace {

// The third corner of a triangle that has the corners u and v; kNone if it does not have both.
Index opposite(const Triangle& t, Index u, Index v) {
  if (t[0] == u) return t[1] == v ? t[2] : t[2] == v ? t[1] : kNone;
  if (t[1] == u) return t[0] == v ? t[2] : t[2] == v ? t[0] : kNone;
  if (t[2] == u) return t[0] == v ? t[1] : t[1] == v ? t[0] : kNone;
  return kNone;
}

}  // namespace

Surface::Surface(const Mesh& mesh) : vertices_(mesh.vertex_count), triangles_(mesh.triangles.size()) {
  const Edges edges = find_edges(mesh);
  edges_.resize(edges.ends.size());
  for (Index e = 0; e < edges_.size(); ++e) {
    edges_[e] = {edges.ends[e], edges.triangle_count[e]};
    for (const Index end : edges.ends[e]) ++vertices_[end].edges.count;
  }
  for (Index t = 0; t < triangles_.size(); ++t) {
    triangles_[t].corners = mesh.triangles[t];
    if (is_degenerate(mesh.triangles[t]))
      triangles_[t].corners[0] = kNone;
    else
      for (const Index corner : mesh.triangles[t]) ++vertices_[corner].triangles.count;
  }
  Index triangle_total = 0, edge_total = 0;
  for (VertexRecord& v : vertices_) {
    v.triangles.begin = triangle_total;
    v.edges.begin = edge_total;
    triangle_total += v.triangles.count;
    edge_total += v.edges.count;
    vertex_count_ += v.edges.count > 0;
    v.triangles.count = v.edges.count = 0;
  }
  triangles_of_.resize(triangle_total);
  edges_of_.resize(edge_total);
  const auto append = [](Run& run, std::vector<Index>& items, Index item) { items[run.begin + run.count++] = item; };
  for (Index t = 0; t < triangles_.size(); ++t)
    if (triangles_[t].corners[0] != kNone)
      for (const Index corner : triangles_[t].corners) append(vertices_[corner].triangles, triangles_of_, t);
  for (Index e = 0; e < edges_.size(); ++e)
    for (const Index end : edges_[e].ends) append(vertices_[end].edges, edges_of_, e);
}

void Surface::fetch_runs(Index edge) const {
  if (!is_alive(edge)) return;
  for (const Index end : ends(edge)) {
    __builtin_prefetch(&triangles_of_[vertices_[end].triangles.begin]);
    __builtin_prefetch(&edges_of_[vertices_[end].edges.begin]);
  }
}

void Surface::fetch_records(Index edge) const {
  if (!is_alive(edge)) return;
  for (const Index end : ends(edge)) {
    const auto& [triangles, edges, count, mark, marked_edge] = vertices_[end];
    for (Index i = 0; i < triangles.count; ++i) __builtin_prefetch(&triangles_[triangles_of_[triangles.begin + i]]);
    for (Index i = 0; i < edges.count; ++i) __builtin_prefetch(&edges_[edges_of_[edges.begin + i]]);
  }
}

bool Surface::keeps_topology(Index edge) {
  //        x            The vertices that u and v are both joined to must be those across the edge (x and y), and
  //      /   \          no edge may lie across both u and v. Singular edges count as joined to a vertex "outside":
  //     u --- v         if u and v both have one, the edge itself must be singular, and no x may be joined to both
  //      \   /          by singular edges.
  //        y
  const auto [u, v] = ends(edge);
  bool u_singular = false, v_singular = false;
  ++stamp_;
  for_each_edge(u, [&](Index e, Index w) {
    vertices_[w].mark = stamp_;
    vertices_[w].marked_edge = e;
    u_singular |= is_singular(e);
  });
  Index joined_to_both = 0;
  bool meets_outside = false;
  for_each_edge(v, [&](Index e, Index w) {
    v_singular |= is_singular(e);
    if (vertices_[w].mark != stamp_) return;  // u itself is not marked
    ++joined_to_both;
    meets_outside |= is_singular(e) && is_singular(vertices_[w].marked_edge);
  });
  if (meets_outside || (u_singular && v_singular && !is_singular(edge))) return false;
  // The two triangles of an edge must be different ones. Only a tetrahedron has an edge across; it may hang at a
  // vertex that has other triangles too.
  if (!is_singular(edge) && joined_to_both != 2) return false;
  return joined_to_both == count_across(u, v) && !(has_edge_across(u, v) && has_edge_across(v, u));
}

Index Surface::count_across(Index u, Index v) {
  Index count = 0;
  ++stamp_;
  for_each_triangle(v, [&](Index t) {
    const Index w = opposite(triangles_[t].corners, v, u);
    if (w == kNone || vertices_[w].mark == stamp_) return;
    vertices_[w].mark = stamp_;
    ++count;
  });
  return count;
}

bool Surface::has_edge_across(Index u, Index v) {
  bool found = false;
  for_each_triangle(u, [&](Index t) {
    int marked = 0;
    for (const Index corner : triangles_[t].corners)
      marked += corner != u && corner != v && vertices_[corner].mark == stamp_;
    found |= marked == 2;
  });
  return found;
}

void Surface::contract(Index edge) {
  assert(is_alive(edge));
  const auto [u, v] = ends(edge);
  edges_[edge].ends[0] = kNone;
  ++stamp_;
  for_each_edge(u, [&](Index e, Index w) {
    vertices_[w].mark = stamp_;
    vertices_[w].marked_edge = e;
  });
  for_each_triangle(v, [&, u = u, v = v](Index t) {
    Triangle& corners = triangles_[t].corners;
    const Index w = opposite(corners, u, v);
    if (w == kNone) {
      corners[corners[0] == v ? 0 : corners[1] == v ? 1 : 2] = u;
    } else {
      corners[0] = kNone;
      edges_[vertices_[w].marked_edge].triangle_count -= 2;  // one of uw, one of vw, which joins it below
    }
  });
  for_each_edge(v, [&, u = u, v = v](Index e, Index w) {
    EdgeRecord& record = edges_[e];
    if (vertices_[w].mark == stamp_) {
      edges_[vertices_[w].marked_edge].triangle_count += record.triangle_count;
      record.ends[0] = kNone;
    } else {
      record.ends[record.ends[0] == v ? 0 : 1] = u;
    }
  });

  VertexRecord& stays = vertices_[u];
  VertexRecord& goes = vertices_[v];
  join(stays.triangles, goes.triangles, triangles_of_);
  join(stays.edges, goes.edges, edges_of_);
  stays.contraction_count += goes.contraction_count + 1;
  --vertex_count_;
}

void Surface::join(Run& stays, Run& goes, std::vector<Index>& items) {
  const auto begin = static_cast<Index>(items.size());
  items.resize(items.size() + stays.count + goes.count);
  std::copy_n(items.begin() + stays.begin, stays.count, items.begin() + begin);
  std::copy_n(items.begin() + goes.begin, goes.count, items.begin() + begin + stays.count);
  stays = {begin, stays.count + goes.count};
  goes = {};
}

}  // namespace limber
