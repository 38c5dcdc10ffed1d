// SPDX-License-Identifier: Apache-2.0
// A 4-K mesh that grows from its coarsest triangles, as operations are reversed one after the other: what the encoder
// and the decoder of four-face files share.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "limber/base/mesh.h"
#include "limber/fourface/four_k_mesh.h"

namespace limber {

// How an operation is reversed. (u, s, w) is the triangle it is told by; v is the vertex that comes or stays.
enum class Refinement : std::uint8_t {
  kFour,         // with (u, w, t) beside it: (v, u, s) (v, s, w) (v, w, t) (v, t, u)
  kThree,        // (v, u, s) (v, s, w) (v, w, u)
  kBorderFirst,  // on the border edge from w to u: (v, u, s) (v, s, w)
  kBorderLast,   // on the border edge from u to s: (v, s, w) (v, w, u)
  kSwap,  // u is v; with (t, s, r), across the edge from s = its second corner to w = its third: (v, s, r) (v, r, w)
};

class FourKGrowth {
 public:
  // The next vertices; their numbers are those of the file.
  Index add_vertex();
  // Precondition: three different corners, all there.
  void add_coarsest(const Triangle& triangle);

  Index vertex_count() const { return static_cast<Index>(stars_.size()); }
  Index operation_count() const { return static_cast<Index>(operations_.size()); }
  Index triangle_count() const { return static_cast<Index>(triangles_.size()); }
  const Triangle& triangle(Index t) const { return triangles_[t]; }
  // The triangles of a vertex, in an order that is the same for everyone who does the same.
  std::span<const Index> star(Index v) const { return stars_[v]; }
  // Of a vertex that came by refinement: those it came between. None of the coarsest.
  std::span<const Index> parents(Index v) const { return {parents_[v].data(), parent_count_[v]}; }

  // Reverses an operation that created the triangle at `place` of the star of u. v: the last vertex, which has no
  // triangles yet; u itself for a swap. The triangle begins with u from now on. False, and nothing has happened, where
  // the triangles do not lie as they should.
  bool refine(Refinement kind, Index u, Index place, Index v);
  // The triangles that the last refinement brought.
  std::span<const Index> brought() const { return {operations_.back().fine.data(), operations_.back().fine_count}; }

  // The 4-K mesh so far: without levels, errors and radii; its last operation is the first that was reversed.
  FourKMesh assemble() const;

 private:
  struct Operation {
    std::array<Index, 2> coarse{kNone, kNone};
    std::array<Index, 4> fine{kNone, kNone, kNone, kNone};
    Index vertex = kNone;
    std::uint8_t coarse_count = 0, fine_count = 0;
  };

  Index across(Index from, Index to) const;
  void add(Operation& operation, const Triangle& triangle);
  void remove(Index triangle);

  std::vector<Triangle> triangles_;
  std::vector<Operation> operations_;
  std::vector<std::vector<Index>> stars_;
  std::vector<std::array<Index, 4>> parents_;
  std::vector<std::uint8_t> parent_count_;
};

}  // namespace limber
