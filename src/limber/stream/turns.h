// SPDX-License-Identifier: Apache-2.0
// How far each node above the finest level has turned since the frame before. Part of the player.
//
// The rotation vector w of a cluster whose vertices went from a_j to b_j (both less their mean) has the least
// sum |b_j - a_j - w x a_j|^2:
//
//   (tr(C) I - C) w = sum a_j x b_j,   C = sum a_j a_j'
//
// so that |w| is the sine of the angle. All of this is sums over vertices, which add up the levels. A small cluster
// says little about turning and costs as much as a large one: those of the finer levels turn with their ancestors, as
// do those of fewer than three vertices. In doubles, with sums, products, quotients and square roots only, in the order
// of the nodes: the same everywhere.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "limber/base/vec.h"
#include "limber/hierarchy/hierarchy.h"
#include "limber/stream/quantizer.h"
#include "limber/stream/traversal.h"

namespace limber {

class Turns {
 public:
  explicit Turns(std::span<const Index> level_begin);

  // `before`, `now`: [vertex_count], by place; `parent`: [node_count], as it is now.
  void measure(std::span<const Index> parent, const Traversal& traversal, std::span<const Lattice> before,
               std::span<const Lattice> now);

  // A vector that turns with a node above the finest level, after the turn. `parent`: as it was measured.
  Vec3d turned(std::span<const Index> parent, Index node, const Vec3d& v) const {
    while (node < first_) node = parent[node];
    const Turn& turn = turns_[node - first_];
    const Vec3d across = cross(turn.half, v);
    return v + (across + cross(turn.half, across)) * turn.factor;
  }

 private:
  // Sums of a, of b, of a x b, of a a' (xx xy xz yy yz zz), and of 1, about the origin. An array: added in one sweep.
  using Moments = std::array<double, 16>;

  // Rodrigues' formula: `half` is the axis times the tangent of half the angle, factor = 2 / (1 + |half|^2).
  struct Turn {
    Vec3d half;
    double factor = 0;
  };

  static Turn turn(const Moments& moments);

  Index level_;  // the lowest that is measured
  Index first_;  // its first node; moments and turns are by node less this
  std::vector<Moments> moments_;
  std::vector<Turn> turns_;
};

}  // namespace limber
