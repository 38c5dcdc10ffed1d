// SPDX-License-Identifier: Apache-2.0
#include "limber/contract/surface.h"

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
  for (auto t = static_cast<Index>(triangles_.size()); t-- > 0;) {
    triangles_[t] = {mesh.triangles[t], {kNone, kNone, kNone}};
    if (is_degenerate(mesh.triangles[t])) {
      triangles_[t].corners[0] = kNone;
      continue;
    }
    for (Index i = 3; i-- > 0;) {
      Link& list = vertices_[mesh.triangles[t][i]].corners;
      if (list.head == kNone) list.tail = 3 * t + i;
      triangles_[t].next[i] = list.head;
      list.head = 3 * t + i;
    }
  }
  const Edges edges = find_edges(mesh);
  edges_.resize(edges.ends.size());
  for (auto e = static_cast<Index>(edges_.size()); e-- > 0;) {
    edges_[e] = {edges.ends[e], {kNone, kNone}, edges.triangle_count[e]};
    for (Index i = 2; i-- > 0;) {
      Link& list = vertices_[edges_[e].ends[i]].half_edges;
      if (list.head == kNone) list.tail = 2 * e + i, ++vertex_count_;
      edges_[e].next[i] = list.head;
      list.head = 2 * e + i;
    }
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
  Index u_valence = 0, v_valence = 0;
  ++stamp_;
  for_each_edge(u, [&](Index e, Index w) {
    vertices_[w].mark = stamp_;
    vertices_[w].marked_edge = e;
    u_singular |= is_singular(e);
    ++u_valence;
  });
  Index joined_to_both = 0;
  bool meets_outside = false;
  for_each_edge(v, [&](Index e, Index w) {
    v_singular |= is_singular(e);
    ++v_valence;
    if (vertices_[w].mark != stamp_) return;  // u itself is not marked
    ++joined_to_both;
    meets_outside |= is_singular(e) && is_singular(vertices_[w].marked_edge);
  });
  if (meets_outside || (u_singular && v_singular && !is_singular(edge))) return false;
  // Inside a manifold there are two triangles on the edge, and only a tetrahedron has an edge across.
  if (!u_singular && !v_singular && (u_valence > 3 || v_valence > 3)) return joined_to_both == 2;
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
  if (goes.corners.head != kNone) {
    (stays.corners.head == kNone ? stays.corners.head
                                 : triangles_[stays.corners.tail / 3].next[stays.corners.tail % 3]) = goes.corners.head;
    stays.corners.tail = goes.corners.tail;
  }
  if (goes.half_edges.head != kNone) {
    (stays.half_edges.head == kNone ? stays.half_edges.head
                                    : edges_[stays.half_edges.tail / 2].next[stays.half_edges.tail % 2]) =
        goes.half_edges.head;
    stays.half_edges.tail = goes.half_edges.tail;
  }
  goes.corners = goes.half_edges = {};
  stays.contraction_count += goes.contraction_count + 1;
  --vertex_count_;
}

}  // namespace limber
