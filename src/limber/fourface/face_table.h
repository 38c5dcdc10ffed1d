// SPDX-License-Identifier: Apache-2.0
// A triangle mesh under edge swaps and vertex removals: faces that know the half-edges across their edges.
//
// The half-edge 4 f + i runs from corner i of face f to the next corner. Where the input is not an oriented manifold
// (an edge of more than two triangles, of two that pass it in the same direction, a vertex between several fans) the
// vertices concerned are `complex`: they can be corners, but not be walked around.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "limber/base/mesh.h"
#include "limber/contract/fetch.h"

namespace limber {

// Half a line of the cache.
struct alignas(32) Face {
  static constexpr unsigned kMostDepth = (1u << 13) - 1;

  std::array<Index, 3> corners{};  // corners[0] is kNone in a dead one
  std::array<Index, 3> twins{};    // the half-edge across edge i; kNone on a border
  Index triangle = kNone;          // whatever the caller calls it
  std::uint16_t operations = 0;    // for the caller, who counts those that have led to it in a row
  std::uint16_t depth : 13 = 0;    // for the caller
  std::uint16_t lines : 3 = 0;     // bit i: edge i belongs to a line, a border or an edge that was tagged

  void add_line(unsigned edge) { lines = (lines | 1u << edge) & 7u; }
  void drop_line(unsigned edge) { lines = lines & ~(1u << edge) & 7u; }
};
static_assert(sizeof(Face) == 32);

// The faces around a vertex, counter-clockwise.
struct Star {
  static constexpr std::uint32_t kMostNeighbours = 40;

  Index center;
  std::uint32_t count;  // neighbours
  bool closed;          // false: a border vertex; the first and the last neighbour are joined to it by border edges
  std::array<Index, kMostNeighbours> ring;   // [count]: the neighbours
  std::array<Index, kMostNeighbours> spoke;  // [face_count()]: the half-edge from center to ring[i], whose face is
                                             // (center, ring[i], ring[i + 1])

  std::uint32_t face_count() const { return closed ? count : count - 1; }
  // The place of a neighbour. Precondition: it is there.
  std::uint32_t place_of(Index neighbour) const {
    std::uint32_t i = 0;
    while (ring[i] != neighbour) ++i;
    return i;
  }
};

class FaceTable {
 public:
  // Degenerate triangles are left out. triangle of face f: f's place among those that are left.
  explicit FaceTable(const Mesh& mesh);

  // Whether every edge has two triangles, which pass it in different directions.
  bool is_closed() const { return is_closed_; }
  // Whether two triangles pass an edge of theirs alone in the same direction.
  bool has_turned_edges() const { return has_turned_edges_; }

  Face& face(Index f) { return faces_[f]; }
  const Face& face(Index f) const { return faces_[f]; }
  Index face_slots() const { return static_cast<Index>(faces_.size()); }  // dead ones among them
  Index face_count() const { return face_count_; }
  Index vertex_count() const { return static_cast<Index>(vertices_.size()); }

  static Index face_of(Index half_edge) { return half_edge >> 2; }
  static Index next(Index half_edge) { return (half_edge & 3) == 2 ? half_edge - 2 : half_edge + 1; }
  static Index previous(Index half_edge) { return (half_edge & 3) == 0 ? half_edge + 2 : half_edge - 1; }
  Index origin(Index half_edge) const { return faces_[half_edge >> 2].corners[half_edge & 3]; }
  Index target(Index half_edge) const { return origin(next(half_edge)); }
  Index twin(Index half_edge) const { return faces_[half_edge >> 2].twins[half_edge & 3]; }
  bool is_line(Index half_edge) const { return faces_[half_edge >> 2].lines >> (half_edge & 3) & 1; }

  // Makes a line of the edge between two vertices. Gives a half-edge of it; kNone where there is no edge of two faces,
  // or both vertices are complex.
  Index tag_edge(Index a, Index b);

  // Half-edges that start at the vertex; kNone where it has none (any more).
  Index outgoing(Index v) const { return vertices_[v].outgoing; }
  bool is_complex(Index v) const { return vertices_[v].complex; }

  // Ask for the memory that gather() will need, in steps, each some time before the next: that of the vertex; a face
  // of it, and once more for the faces that are `steps` = 1, 2, ... away from that on both sides, visit(corner) for
  // those of the ones before.
  void fetch_vertex(Index v) const { fetch(&vertices_[v]); }
  void fetch_face(Index v) const {
    if (vertices_[v].outgoing != kNone) fetch(&faces_[face_of(vertices_[v].outgoing)]);
  }
  template <class Visit>
  void fetch_faces(Index v, int steps, const Visit& visit) const {
    Index left = vertices_[v].outgoing, right = left;
    if (left == kNone) return;
    for (int i = 1; i < steps; ++i) {
      if (left != kNone) left = twin(previous(left));
      if (right != kNone && twin(right) != kNone) right = next(twin(right));
    }
    if (left != kNone) {
      visit(target(left));
      if (const Index across = twin(previous(left)); across != kNone) fetch(&faces_[face_of(across)]);
    }
    visit(origin(previous(right)));
    if (const Index across = twin(right); across != kNone) fetch(&faces_[face_of(across)]);
  }
  // That of the faces around the star, which removing its center will change.
  void fetch_around(const Star& star) const {
    for (std::uint32_t i = 0; i < star.face_count(); ++i)
      if (const Index across = twin(next(star.spoke[i])); across != kNone) fetch(&faces_[face_of(across)]);
  }

  // False where v has no faces, is complex, or has too many neighbours.
  bool gather(Index v, Star& star) const;

  // Whether two vertices are joined by an edge; true if both are complex. Precondition: neither is isolated.
  bool has_edge(Index a, Index b) const {
    if (!(vertices_[a].neighbours & bit_of(b)) || !(vertices_[b].neighbours & bit_of(a)))
      return vertices_[a].complex && vertices_[b].complex;
    return find_edge(a, b);
  }
  // has_edge() is fastest when this has been called since many edges have gone.
  void forget_old_edges();

  // Turns the edge from v to its neighbour r at `place` of its star, between the neighbours s and t, into s t: the
  // faces (v, s, r) and (v, r, t) become (v, s, t) and (s, r, t), which are given. The star is kept up to date.
  // Precondition: s t is no edge, v r is no border edge, and v has more than three faces.
  std::array<Index, 2> swap(Star& star, std::uint32_t place);

  // Removes v, whose star has four neighbours u, s, w, t from `first` on: (u, s, w) and (u, w, t) are left, in the
  // faces given. `line`: whether u w becomes a line. Precondition: u w is no edge.
  std::array<Index, 2> remove_between_four(const Star& star, std::uint32_t first, bool line);
  // Removes a border vertex with three neighbours, or an inner one with three: one face is left.
  Index remove_between_three(const Star& star);

 private:
  void pair_half_edges(const Mesh& mesh);
  void find_complex_vertices();
  void set(Index face, const std::array<Index, 3>& corners);
  // Edge `side` of `face` gets what lies across `old_half_edge`, and its line.
  struct Outer {
    Index twin;
    bool line;
  };
  Outer outer(Index half_edge) const { return {twin(half_edge), is_line(half_edge)}; }
  void attach(Index face, unsigned side, const Outer& across);
  void join(Index half_edge, Index other, bool line);
  void kill(Index face);
  Index first_of_fan(Index half_edge) const;
  bool find_edge(Index a, Index b) const;
  static std::uint64_t bit_of(Index v) { return std::uint64_t{1} << (v * 0x9e3779b1u >> 26); }
  void add_neighbours(const Face& face) {
    for (std::size_t i = 0; i < 3; ++i)
      vertices_[face.corners[i]].neighbours |= bit_of(face.corners[(i + 1) % 3]) | bit_of(face.corners[(i + 2) % 3]);
  }

  std::vector<Face> faces_;
  struct Vertex {
    // The bits of all neighbours, and of some that are none any more. What is not there is no neighbour, which is how
    // nearly every question for an edge is answered without going around a vertex.
    std::uint64_t neighbours = 0;
    Index outgoing = kNone;
    bool complex = false;
  };

  std::vector<Vertex> vertices_;  // [vertex_count]
  Index face_count_ = 0;
  bool is_closed_ = true;
  bool has_turned_edges_ = false;
};

}  // namespace limber
