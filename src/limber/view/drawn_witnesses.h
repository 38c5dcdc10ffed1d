// SPDX-License-Identifier: Apache-2.0
// How far what is drawn is from the surface: the other direction than witnesses.h, and the same idea. Samples of what
// is drawn have a finest triangle each for a witness, and are no farther from the surface than from that. Part of the
// player: standard library only.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "limber/base/mesh.h"
#include "limber/hierarchy/hierarchy.h"
#include "limber/view/stars.h"
#include "limber/view/triangle_list.h"
#include "limber/view/witnesses.h"

namespace limber {

class DrawnWitnesses {
 public:
  DrawnWitnesses(const Mesh& mesh, const Hierarchy& hierarchy);

  // A new frame: nothing is known of it.
  void begin();

  // Looks for a witness of every drawn node above the finest level, of the middles of the sides of every triangle, and
  // of its centre; the sides and triangles of finest vertices alone are the surface itself. Only what was not drawn at
  // the calls since begin() is looked at. First the witness of the frame before is tried, then those downhill from a
  // vertex below. `weights`: [node_count - vertex_count], of nodes; a place between nodes has the largest of theirs.
  // Where has_changed, [vertex_count], is not empty, only labels of these vertices have changed since the last call.
  // Does not allocate.
  void find(const Mesh& mesh, const Stars& stars, const DrawnSurface& drawn, std::span<const float> weights,
            float limit, std::span<const std::uint8_t> has_changed = {});

  // A sample without a witness within the limit: the coarsest node that it lies between, and its bound.
  struct Failure {
    Index node = kNone;
    float square = 0;  // of the weighted distance
  };
  std::span<const Failure> failing() const { return failing_; }

  // The largest square of a weighted distance since begin() that was no failure.
  float largest_square() const { return largest_square_; }

 private:
  float bound(const Mesh& mesh, const Stars& stars, const DrawnSurface& drawn, const Vec3f& point, Index start,
              float enough, Index& witness);

  std::vector<Index> node_faces_;            // [node_count - vertex_count]: witnesses
  std::vector<std::array<Index, 4>> faces_;  // [triangle_count]: of the sides and the centre of its image
  std::vector<std::uint32_t> known_at_;      // [node_count]: the round in which a node was first drawn
  std::vector<Failure> failing_;
  TriangleList list_;
  float largest_square_ = 0;
  std::uint32_t first_round_ = 1, round_ = 1;
};

}  // namespace limber
