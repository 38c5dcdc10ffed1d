// SPDX-License-Identifier: Apache-2.0
// A mesh under edge contraction: a 2-complex of vertices, edges and triangles that need not be manifold. Edges
// live on when all their triangles have degenerated (docs/design.md, "A level is a 2-complex").
//
// Each vertex lists its triangles and edges in a run of one array; a contraction writes the run of the vertex that
// stays anew at the end of it, and what is dead leaves a run when the run is walked. Runs and records, not links and
// arrays of fields: a contraction visits a random handful of neighbours, and waiting for memory is what it costs.
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

  // Ask for the memory that contracting an edge will need, in three steps, each some time before the next: where its
  // ends list things, what they list, and the vertices around them, for which visit(vertex) is called too. The edge may
  // be dead.
  void fetch_runs(Index edge) const;
  void fetch_records(Index edge) const;
  template <class Visit>
  void fetch_neighbours(Index edge, Visit&& visit) const;
  // For age() of the edge: its ends; visit(vertex) as above.
  template <class Visit>
  void fetch_ends(Index edge, Visit&& visit) const;

  // Whether the contraction of a living edge keeps the surface homeomorphic: the link condition of Dey,
  // Edelsbrunner, Guha & Nekhayev 1998, where borders and non-manifold edges are joined to one vertex outside.
  bool keeps_topology(Index edge);

  // Moves everything of ends(edge)[1] to ends(edge)[0]; triangles on the edge degenerate, edges that coincide
  // become one. Precondition: the edge is alive.
  void contract(Index edge);

 private:
  struct Run {
    Index begin = 0, count = 0;
  };
  struct VertexRecord {
    Run triangles;                // of triangles_of_
    Run edges;                    // of edges_of_
    Index contraction_count = 0;  // vertices taken in
    Index mark = 0;               // scratch: marked when == stamp_
    Index marked_edge = kNone;    // scratch: the edge that the mark came over
  };
  struct TriangleRecord {
    Triangle corners;  // corners[0] is kNone in a dead one
  };
  struct EdgeRecord {
    std::array<Index, 2> ends;  // ends[0] is kNone in a dead one
    Index triangle_count = 0;   // living triangles on the edge
  };

  // A border or non-manifold edge.
  bool is_singular(Index edge) const { return edges_[edge].triangle_count != 2; }
  // How many different vertices lie across the edge uv in its triangles. Marks them for has_edge_across.
  Index count_across(Index u, Index v);
  // Appends the run of the vertex that goes to that of the one that stays, at the end of the array.
  static void join(Run& stays, Run& goes, std::vector<Index>& items);
  // Whether a triangle of u has an edge between two marked vertices.
  bool has_edge_across(Index u, Index v);

  std::vector<VertexRecord> vertices_;
  std::vector<TriangleRecord> triangles_;
  std::vector<EdgeRecord> edges_;
  std::vector<Index> triangles_of_, edges_of_;  // runs, one per vertex, and what they leave behind
  Index vertex_count_ = 0;
  Index stamp_ = 0;
};

template <class Visit>
void Surface::fetch_neighbours(Index edge, Visit&& visit) const {
  if (!is_alive(edge)) return;
  for (const Index end : ends(edge)) {
    const Run& run = vertices_[end].triangles;
    for (Index i = 0; i < run.count; ++i) {
      const Triangle& corners = triangles_[triangles_of_[run.begin + i]].corners;
      if (corners[0] == kNone) continue;
      for (const Index corner : corners) {
        __builtin_prefetch(&vertices_[corner]);
        visit(corner);
      }
    }
  }
}

template <class Visit>
void Surface::fetch_ends(Index edge, Visit&& visit) const {
  if (!is_alive(edge)) return;
  for (const Index end : ends(edge)) {
    __builtin_prefetch(&vertices_[end]);
    visit(end);
  }
}

template <class Visit>
void Surface::for_each_edge(Index v, Visit&& visit) {
  Run& run = vertices_[v].edges;
  Index* const items = edges_of_.data() + run.begin;
  Index living = 0;
  for (Index i = 0; i < run.count; ++i) {
    const Index e = items[i];
    const std::array<Index, 2>& ends = edges_[e].ends;
    if (ends[0] == kNone) continue;
    items[living++] = e;
    visit(e, ends[0] == v ? ends[1] : ends[0]);
  }
  run.count = living;
}

template <class Visit>
void Surface::for_each_triangle(Index v, Visit&& visit) {
  Run& run = vertices_[v].triangles;
  Index* const items = triangles_of_.data() + run.begin;
  Index living = 0;
  for (Index i = 0; i < run.count; ++i) {
    const Index t = items[i];
    if (triangles_[t].corners[0] == kNone) continue;
    items[living++] = t;
    visit(t);
  }
  run.count = living;
}

}  // namespace limber
