// SPDX-License-Identifier: Apache-2.0
#include "limber/contract/surface.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace limber {
namespace {

// The third corner of a triangle of v that has the corner u too; kNone if it does not. No branch could be predicted.
Index opposite(const Triangle& t, Index u, Index v) {
  const bool has_u = (t[0] == u) + (t[1] == u) + (t[2] == u) > 0;
  return has_u ? t[0] ^ t[1] ^ t[2] ^ u ^ v : kNone;
}

}  // namespace

Surface::Surface(const Mesh& mesh, const Edges& edges)
    : vertices_(mesh.vertex_count), triangles_(mesh.triangles), marks_(mesh.vertex_count, 0) {
  edges_.resize(edges.ends.size());
  for (Index e = 0; e < edges_.size(); ++e) {
    edges_[e] = {edges.ends[e], edges.triangle_count[e]};
    for (const Index end : edges.ends[e]) ++vertices_[end].edges.count;
  }
  for (Triangle& t : triangles_) {
    if (is_degenerate(t))
      t[0] = kNone;
    else
      for (const Index corner : t) ++vertices_[corner].triangles.count;
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
  const auto begin_runs = [](std::vector<Index>& items, std::size_t count) {
    items.reserve(count * 5 / 2);  // what a contraction to a tenth takes
    items.resize(count);
  };
  begin_runs(triangles_of_, triangle_total);
  begin_runs(edges_of_, edge_total);
  const auto append = [](Run& run, std::vector<Index>& items, Index item) { items[run.begin + run.count++] = item; };
  for (Index t = 0; t < triangles_.size(); ++t)
    if (triangles_[t][0] != kNone)
      for (const Index corner : triangles_[t]) append(vertices_[corner].triangles, triangles_of_, t);
  for (Index e = 0; e < edges_.size(); ++e)
    for (const Index end : edges_[e].ends) append(vertices_[end].edges, edges_of_, e);
}

void Surface::fetch_runs(Index edge) const {
  if (!is_alive(edge)) return;
  for (const Index end : ends(edge)) {
    fetch(triangles_of_.data() + vertices_[end].triangles.begin);
    fetch(edges_of_.data() + vertices_[end].edges.begin);
  }
}

void Surface::fetch_records(Index edge) const {
  if (!is_alive(edge)) return;
  for (const Index end : ends(edge)) {
    const auto& [triangles, edges] = vertices_[end];
    for (Index i = 0; i < triangles.count; ++i) fetch(&triangles_[triangles_of_[triangles.begin + i]]);
    for (Index i = 0; i < edges.count; ++i) fetch(&edges_[edges_of_[edges.begin + i]]);
  }
}

bool Surface::keeps_topology(Index edge) {
  //        x            The vertices that u and v are both joined to must be those across the edge (x and y), and
  //      /   \          no edge may lie across both u and v. Singular edges count as joined to a vertex "outside":
  //     u --- v         if u and v both have one, the edge itself must be singular, and no x may be joined to both
  //      \   /          by singular edges.
  //        y
  const auto [u, v] = ends(edge);
  mark_neighbours(u);
  bool v_is_singular = false, meets_outside = false;
  Index joined_to_both = 0;
  for_each_edge(v, [&](Index e, Index w) {
    v_is_singular |= is_singular(e);
    if (!is_marked(w)) return;  // u itself is not marked
    ++joined_to_both;
    meets_outside |= is_singular(e) && is_singular(marked_edge(w));
  });
  if (meets_outside || (center_is_singular_ && v_is_singular && !is_singular(edge))) return false;
  // The two triangles of an edge must be different ones.
  if (!is_singular(edge) && joined_to_both != 2) return false;
  across_.clear();
  bool may_hang = false;
  for_each_triangle(v, [&, u = u, v = v](Index t) {
    const Triangle& corners = triangles_[t];
    if (const Index w = opposite(corners, u, v); w != kNone) across_.push_back(w);
    may_hang |= is_marked(corners[0]) + is_marked(corners[1]) + is_marked(corners[2]) == 3;
  });
  std::sort(across_.begin(), across_.end());
  across_.erase(std::unique(across_.begin(), across_.end()), across_.end());
  // Only a tetrahedron has an edge across; it may hang at a vertex that has other triangles too.
  return joined_to_both == across_.size() && !(may_hang && has_edge_across(u));
}

void Surface::mark_neighbours(Index u) {
  if (center_ == u) return;
  const Run& run = vertices_[u].edges;
  first_mark_ += mark_count_;
  if (kNone - first_mark_ < run.count) {
    std::fill(marks_.begin(), marks_.end(), 0);
    first_mark_ = 1;
  }
  center_ = u;
  mark_count_ = 0;
  center_is_singular_ = false;
  for_each_edge(u, [&](Index e, Index w) {
    marks_[w] = first_mark_ + mark_count_++;
    center_is_singular_ |= is_singular(e);
  });
}

bool Surface::has_edge_across(Index u) {
  const auto is_across = [&](Index w) { return std::binary_search(across_.begin(), across_.end(), w); };
  bool found = false;
  for_each_triangle(u, [&](Index t) {
    const Triangle& corners = triangles_[t];
    found |= is_across(corners[0]) + is_across(corners[1]) + is_across(corners[2]) == 2;
  });
  return found;
}

std::span<const Index> Surface::contract(Index edge) {
  assert(is_alive(edge));
  const auto [u, v] = ends(edge);
  mark_neighbours(u);
  VertexRecord& stays = vertices_[u];
  VertexRecord& goes = vertices_[v];
  const auto open = [](std::vector<Index>& items, const Run& a, const Run& b) {
    const auto begin = static_cast<Index>(items.size());
    items.resize(items.size() + a.count + b.count);
    return Run{begin, 0};
  };

  Run triangles = open(triangles_of_, stays.triangles, goes.triangles);
  for_each_triangle(v, [&, u = u, v = v](Index t) {
    Triangle& corners = triangles_[t];
    const Index w = opposite(corners, u, v);
    if (w == kNone) {
      for (Index& corner : corners) corner = corner == v ? u : corner;
      triangles_of_[triangles.begin + triangles.count++] = t;
    } else {
      corners[0] = kNone;
      edges_[marked_edge(w)].triangle_count -= 2;  // one of uw, one of vw, which joins it below
    }
  });
  for_each_triangle(u, [&](Index t) { triangles_of_[triangles.begin + triangles.count++] = t; });
  triangles_of_.resize(triangles.begin + triangles.count);

  gone_.assign(1, edge);
  Run edges = open(edges_of_, stays.edges, goes.edges);
  for_each_edge(v, [&, u = u, v = v](Index e, Index w) {
    if (e == edge) return;
    EdgeRecord& record = edges_[e];
    if (is_marked(w)) {
      edges_[marked_edge(w)].triangle_count += record.triangle_count;
      record.ends[0] = kNone;
      gone_.push_back(e);
    } else {
      record.ends[record.ends[0] != v] = u;
      edges_of_[edges.begin + edges.count++] = e;
    }
  });
  edges_[edge].ends[0] = kNone;
  const auto kept = edges_of_.begin() + stays.edges.begin, end = edges_of_.begin() + edges.begin + edges.count;
  edges.count += static_cast<Index>(std::remove_copy(kept, kept + stays.edges.count, end, edge) - end);
  edges_of_.resize(edges.begin + edges.count);

  stays = {triangles, edges};
  goes = {};
  center_ = kNone;
  --vertex_count_;
  return gone_;
}

}  // namespace limber
