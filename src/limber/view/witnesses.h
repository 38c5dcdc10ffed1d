// SPDX-License-Identifier: Apache-2.0
// How far the surface is from what is drawn of it, as a bound that is proved in every frame: every finest vertex has a
// witness, a triangle that is drawn, and is no farther from what is drawn than from that.
// Part of the player: standard library only.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "limber/base/mesh.h"
#include "limber/base/vec.h"
#include "limber/view/stars.h"

namespace limber {

// A frame and a cut through it.
struct DrawnSurface {
  std::span<const Vec3f> positions;  // [node_count]
  std::span<const Index> labels;     // [vertex_count] or longer: the active node of each finest vertex
  std::span<const float> weights;    // [vertex_count]: what a distance of 1 counts at each finest vertex, >= 0
};

class Witnesses {
 public:
  explicit Witnesses(const Mesh& mesh);

  // Looks for witnesses within the limit (a weighted distance): first the triangle that was the witness before, where
  // it still is one, then those around the vertex, and the witnesses of its neighbours, which hand them on. So what is
  // found depends on what was found before; that it bounds the distance does not. Does not allocate.
  // Preconditions: the mesh and stars are those of the constructor's mesh; limit >= 0.
  void find(const Mesh& mesh, const Stars& stars, const DrawnSurface& drawn, float limit);

  // The same where only the labels of these vertices changed since: has_changed is [vertex_count].
  void find_again(const Mesh& mesh, const Stars& stars, const DrawnSurface& drawn, float limit,
                  std::span<const std::uint8_t> has_changed);

  // Goes on: the same for the middles of the sides of finest triangles, whose ends fail where they do.
  // Where has_changed, [vertex_count], is not empty, only labels of these vertices have changed since the last call.
  // Precondition: find() or find_again() was the call before.
  void find_for_sides(const Mesh& mesh, const Stars& stars, const DrawnSurface& drawn, float limit,
                      std::span<const std::uint8_t> has_changed = {});

  // The largest square of a weighted distance that find_for_sides() found, failures aside, since the call for all.
  float largest_side_square() const { return largest_side_square_; }

  // Vertices without a witness within the limit. Not those that are a corner of no triangle.
  std::span<const Index> failing() const { return failing_; }

  // [vertex_count]: the square of the weighted distance between a finest vertex and its witness.
  // Infinite where there is no witness, 0 where the vertex is a corner of no triangle.
  std::span<const float> squared_bounds() const { return squared_bounds_; }

 private:
  struct Side {
    Index from = kNone, to = kNone;
    Triangle face{};   // the witness of the middle, as in faces_
    float square = 0;  // of its distance, without a weight
    bool fails = false;
  };

  bool offer(const DrawnSurface& drawn, Index v, const Triangle& face);
  bool improve(const Mesh& mesh, const Stars& stars, const DrawnSurface& drawn, Index v, float most);
  void improve_side(const Mesh& mesh, const Stars& stars, const DrawnSurface& drawn, Side& side, float enough);
  bool is_touched(const Side& side, std::span<const std::uint8_t> has_changed) const;
  void flood(const Mesh& mesh, const Stars& stars, const DrawnSurface& drawn);
  void settle(const Mesh& mesh, const Stars& stars, const DrawnSurface& drawn, float limit);

  std::vector<Side> sides_;      // of the finest triangles, each once
  std::vector<Triangle> faces_;  // [vertex_count]: the finest triangle whose image is the witness
  std::vector<float> squared_bounds_;
  std::vector<std::uint8_t> was_sought_;  // [vertex_count]: looked at by the last find_again()
  std::vector<Index> failing_;
  float largest_side_square_ = 0;
  std::vector<Index> queue_;  // scratch
};

}  // namespace limber
