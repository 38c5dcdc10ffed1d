// SPDX-License-Identifier: Apache-2.0
// A mesh under edge contraction: a 2-complex of vertices, edges and triangles that need not be manifold. Edges
// live on when all their triangles have degenerated (docs/design.md, "A level is a 2-complex").
//
// Each vertex lists its triangles and edges in a run of one array; a contraction writes the run of the vertex that
// stays anew at the end of it, and what is dead leaves a run when the run is walked. Runs and records, not links and
// arrays of fields: a contraction visits a random handful of neighbours, and waiting for memory is what it costs.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "limber/base/mesh.h"
#include "limber/contract/edges.h"
#include "limber/contract/fetch.h"

namespace limber {

class Surface {
 public:
  explicit Surface(const Mesh& mesh) : Surface(mesh, find_edges(mesh)) {}
  // edges: find_edges(mesh).
  Surface(const Mesh& mesh, const Edges& edges);

  // All edges that ever were: [0, edge_count()); those that are gone are not alive.
  Index edge_count() const { return static_cast<Index>(edges_.size()); }
  bool is_alive(Index edge) const { return edges_[edge].ends[0] != kNone; }
  // Precondition: the edge is alive.
  const std::array<Index, 2>& ends(Index edge) const { return edges_[edge].ends; }
  // Its living triangles: 1 on a border, 2 inside, more where the surface is not manifold. Precondition: as ends().
  Index triangle_count(Index edge) const { return edges_[edge].triangle_count; }
  const Triangle& triangle(Index t) const { return triangles_[t]; }

  // Vertices that have an edge or had one: what contraction can make fewer.
  Index vertex_count() const { return vertex_count_; }

  // How many triangles v has, counting some that are gone.
  Index triangle_bound(Index v) const { return vertices_[v].triangles.count; }

  // visit(edge, other end) for each living edge of v; visit(triangle) for each living triangle of v.
  template <class Visit>
  void for_each_edge(Index v, Visit&& visit);
  template <class Visit>
  void for_each_triangle(Index v, Visit&& visit);

  // Ask for the memory that contracting an edge will need, in five steps, each some time before the next: the edge; its
  // ends, for which visit(vertex) is called too; where they list things; what they list; and the vertices around them,
  // for which visit(vertex) is called too. The edge may be dead.
  void fetch_edge(Index edge) const { fetch(&edges_[edge]); }
  template <class Visit>
  void fetch_ends(Index edge, Visit&& visit) const;
  void fetch_runs(Index edge) const;
  void fetch_records(Index edge) const;
  template <class Visit>
  void fetch_neighbours(Index edge, Visit&& visit) const;
  // Goes with the fourth step for those who keep something by triangle: visit(triangle) for each triangle of the ends,
  // some maybe dead.
  template <class Visit>
  void fetch_triangles(Index edge, Visit&& visit) const;

  // Whether the contraction of a living edge keeps the surface homeomorphic: the link condition of Dey,
  // Edelsbrunner, Guha & Nekhayev 1998, where borders and non-manifold edges are joined to one vertex outside.
  bool keeps_topology(Index edge);

  // Moves everything of ends(edge)[1] to ends(edge)[0]; triangles on the edge degenerate, edges that coincide
  // become one. Gives the edges that are gone, the contracted one among them, until the next call. Precondition: the
  // edge is alive.
  std::span<const Index> contract(Index edge);

 private:
  struct Run {
    Index begin = 0, count = 0;
  };
  struct VertexRecord {
    Run triangles;  // of triangles_of_
    Run edges;      // of edges_of_
  };
  struct EdgeRecord {
    std::array<Index, 2> ends;  // ends[0] is kNone in a dead one
    Index triangle_count = 0;   // living triangles on the edge
  };

  // Visits what lives in a run, and takes the rest out of it.
  template <class IsAlive, class Visit>
  static void for_each_living(Run& run, std::vector<Index>& items, IsAlive&& is_alive, Visit&& visit);
  // A border or non-manifold edge.
  bool is_singular(Index edge) const { return edges_[edge].triangle_count != 2; }
  // Marks the vertices that u is joined to, and no others, with the places of the edges in the run of u.
  void mark_neighbours(Index u);
  bool is_marked(Index v) const { return marks_[v] - first_mark_ < mark_count_; }
  // The edge that joins a marked vertex to the one whose neighbours are marked.
  Index marked_edge(Index v) const { return edges_of_[vertices_[center_].edges.begin + marks_[v] - first_mark_]; }
  // Whether a triangle of u has two corners in across_.
  bool has_edge_across(Index u);

  std::vector<VertexRecord> vertices_;
  std::vector<Triangle> triangles_;  // corners[0] is kNone in a dead one
  std::vector<EdgeRecord> edges_;
  std::vector<Index> triangles_of_, edges_of_;  // runs, one per vertex, and what they leave behind
  Index vertex_count_ = 0;

  std::vector<Index> marks_;  // [vertex_count]: first_mark_ and more, for the neighbours of center_
  Index center_ = kNone, first_mark_ = 1, mark_count_ = 0;
  bool center_is_singular_ = false;  // has a singular edge
  std::vector<Index> across_;        // scratch: the vertices across an edge in its triangles, sorted, each once
  std::vector<Index> gone_;          // what contract() gives
};

template <class Visit>
void Surface::fetch_ends(Index edge, Visit&& visit) const {
  if (!is_alive(edge)) return;
  for (const Index end : ends(edge)) {
    fetch(&vertices_[end]);
    visit(end);
  }
}

template <class Visit>
void Surface::fetch_neighbours(Index edge, Visit&& visit) const {
  if (!is_alive(edge)) return;
  for (const Index end : ends(edge)) {
    const Run& run = vertices_[end].edges;
    for (Index i = 0; i < run.count; ++i) {
      const std::array<Index, 2>& around = ends(edges_of_[run.begin + i]);
      if (around[0] == kNone) continue;
      const Index v = around[0] ^ around[1] ^ end;
      fetch(&marks_[v]);
      visit(v);
    }
  }
}

template <class Visit>
void Surface::fetch_triangles(Index edge, Visit&& visit) const {
  if (!is_alive(edge)) return;
  for (const Index end : ends(edge)) {
    const Run& run = vertices_[end].triangles;
    for (Index i = 0; i < run.count; ++i) visit(triangles_of_[run.begin + i]);
  }
}

template <class IsAlive, class Visit>
void Surface::for_each_living(Run& run, std::vector<Index>& items, IsAlive&& is_alive, Visit&& visit) {
  Index* const begin = items.data() + run.begin;
  Index living = 0;
  for (Index i = 0; i < run.count; ++i) {
    const Index item = begin[i];
    if (!is_alive(item)) continue;
    begin[living++] = item;
    visit(item);
  }
  run.count = living;
}

template <class Visit>
void Surface::for_each_edge(Index v, Visit&& visit) {
  for_each_living(
      vertices_[v].edges, edges_of_, [this](Index e) { return is_alive(e); },
      [&](Index e) { visit(e, edges_[e].ends[0] ^ edges_[e].ends[1] ^ v); });
}

template <class Visit>
void Surface::for_each_triangle(Index v, Visit&& visit) {
  for_each_living(
      vertices_[v].triangles, triangles_of_, [this](Index t) { return triangles_[t][0] != kNone; }, visit);
}

}  // namespace limber
