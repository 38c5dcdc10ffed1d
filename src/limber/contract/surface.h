// SPDX-License-Identifier: Apache-2.0
// A mesh under edge contraction: a 2-complex of vertices, edges and triangles that need not be manifold. Edges
// live on when all their triangles have degenerated (docs/design.md, "A level is a 2-complex").
//
// Triangles and edges are listed around their vertices by links inside the triangle and edge records; what is dead
// leaves a list when the list is walked. Records, not arrays of fields: a contraction visits a random handful of
// neighbours, and one cache line each is what it costs.
#pragma once

#include <array>
#include <vector>

#include "limber/base/mesh.h"

namespace limber {

class Surface {
 public:
  explicit Surface(const Mesh& mesh);

  // All edges that ever were: [0, edge_count()); those that are gone are not alive.
  Index edge_count() const { return static_cast<Index>(edges_.size()); }
  bool is_alive(Index edge) const { return edges_[edge].ends[0] != kNone; }
  // Precondition for this and the next: the edge is alive.
  const std::array<Index, 2>& ends(Index edge) const { return edges_[edge].ends; }
  // A number that grows whenever an end of the edge takes in another vertex.
  Index age(Index edge) const {
    return vertices_[edges_[edge].ends[0]].contraction_count + vertices_[edges_[edge].ends[1]].contraction_count;
  }
  const Triangle& triangle(Index t) const { return triangles_[t].corners; }

  // Vertices that have an edge or had one: what contraction can make fewer.
  Index vertex_count() const { return vertex_count_; }

  // visit(edge, other end) for each living edge of v; visit(triangle) for each living triangle of v.
  template <class Visit>
  void for_each_edge(Index v, Visit&& visit);
  template <class Visit>
  void for_each_triangle(Index v, Visit&& visit);

  // Whether the contraction of a living edge keeps the surface homeomorphic: the link condition of Dey,
  // Edelsbrunner, Guha & Nekhayev 1998, where borders and non-manifold edges are joined to one vertex outside.
  bool keeps_topology(Index edge);

  // Moves everything of ends(edge)[1] to ends(edge)[0]; triangles on the edge degenerate, edges that coincide
  // become one. Precondition: the edge is alive.
  void contract(Index edge);

 private:
  struct Link {
    Index head = kNone, tail = kNone;
  };
  struct VertexRecord {
    Link corners, half_edges;     // a corner is 3 x triangle + 0..2, a half-edge 2 x edge + 0..1
    Index contraction_count = 0;  // vertices taken in
    Index mark = 0;               // scratch: marked when == stamp_
    Index marked_edge = kNone;    // scratch: the edge that the mark came over
  };
  struct TriangleRecord {
    Triangle corners;  // corners[0] is kNone in a dead one
    std::array<Index, 3> next;
  };
  struct EdgeRecord {
    std::array<Index, 2> ends;  // ends[0] is kNone in a dead one
    std::array<Index, 2> next;  // half-edge i is listed at ends[i]
    Index triangle_count = 0;   // living triangles on the edge
  };

  // A border or non-manifold edge.
  bool is_singular(Index edge) const { return edges_[edge].triangle_count != 2; }
  // How many different vertices lie across the edge uv in its triangles. Marks them for has_edge_across.
  Index count_across(Index u, Index v);
  // Whether a triangle of u has an edge between two marked vertices.
  bool has_edge_across(Index u, Index v);

  std::vector<VertexRecord> vertices_;
  std::vector<TriangleRecord> triangles_;
  std::vector<EdgeRecord> edges_;
  Index vertex_count_ = 0;
  Index stamp_ = 0;
};

template <class Visit>
void Surface::for_each_edge(Index v, Visit&& visit) {
  Link& list = vertices_[v].half_edges;
  Index* link = &list.head;
  Index last = kNone;
  while (*link != kNone) {
    const Index h = *link;
    EdgeRecord& edge = edges_[h / 2];
    if (edge.ends[0] == kNone) {
      *link = edge.next[h % 2];
      continue;
    }
    visit(h / 2, edge.ends[1 - h % 2]);
    last = h;
    link = &edge.next[h % 2];
  }
  list.tail = last;
}

template <class Visit>
void Surface::for_each_triangle(Index v, Visit&& visit) {
  Link& list = vertices_[v].corners;
  Index* link = &list.head;
  Index last = kNone;
  while (*link != kNone) {
    const Index corner = *link;
    TriangleRecord& record = triangles_[corner / 3];
    if (record.corners[0] == kNone) {
      *link = record.next[corner % 3];
      continue;
    }
    visit(corner / 3);
    last = corner;
    link = &record.next[corner % 3];
  }
  list.tail = last;
}

}  // namespace limber
