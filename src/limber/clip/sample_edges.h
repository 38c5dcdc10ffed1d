// SPDX-License-Identifier: Apache-2.0
// A closed triangulation whose edges can be split, collapsed and flipped. Only the sample generators use it.
#pragma once

#include <cassert>
#include <vector>

#include "limber/base/mesh.h"

namespace limber {

// Half-edge h = 3 t + i goes from corner i of triangle t to its corner i + 1.
//
//            c
//          /   \         next(h) = b -> c, prev(h) = c -> a
//        /  h    \       twin(h) = b -> a in the triangle (b, a, d)
//      a --------> b
//        \       /
//          \   /
//            d
class EdgeMesh {
 public:
  // Precondition: `mesh` is closed, manifold and consistently oriented.
  explicit EdgeMesh(const Mesh& mesh);

  Index half_edge_count() const { return static_cast<Index>(from_.size()); }
  Index vertex_slots() const { return static_cast<Index>(out_.size()); }
  Index vertex_count() const { return vertex_count_; }

  bool is_alive(Index h) const { return from_[h] != kNone; }
  bool is_alive_vertex(Index v) const { return out_[v] != kNone; }
  Index from(Index h) const { return from_[h]; }
  Index to(Index h) const { return from_[next(h)]; }
  Index twin(Index h) const { return twin_[h]; }
  static Index next(Index h) { return h % 3 == 2 ? h - 2 : h + 1; }
  static Index prev(Index h) { return h % 3 == 0 ? h + 2 : h - 1; }
  // Some half-edge that leaves v; turn(h) is the one after h around the same vertex.
  Index out(Index v) const { return out_[v]; }
  Index turn(Index h) const { return twin_[prev(h)]; }

  bool has_edge(Index a, Index b) const;

  // Puts a new vertex on the edge, and returns it.
  Index split(Index h);

  // Turns the edge into the one between the two opposite corners.
  bool can_flip(Index h) const;
  void flip(Index h);

  // Merges from(h) into to(h). Allowed where the surface stays the same kind of surface.
  bool can_collapse(Index h) const;
  void collapse(Index h);

  // What is alive, renumbered in order; `kept` receives the old numbers of the vertices.
  Mesh compact(std::vector<Index>& kept) const;

 private:
  void link(Index h, Index g) { twin_[h] = g, twin_[g] = h; }
  int degree(Index v) const;

  std::vector<Index> from_, twin_;  // [half_edge_count]
  std::vector<Index> out_;          // [vertex_slots]
  Index vertex_count_ = 0;
};

}  // namespace limber
