// SPDX-License-Identifier: Apache-2.0
// How much an error counts at each finest vertex of a frame.
// Part of the player: standard library only.
#pragma once

#include <span>
#include <vector>

#include "limber/base/mesh.h"
#include "limber/base/vec.h"
#include "limber/view/view.h"

namespace limber {

class SeenWeights {
 public:
  // Measures all vertices, whose positions are [mesh.vertex_count]. `limit` is the error that the view will be held to,
  // > 0 (see View). With `for_triangles` a vertex counts with the largest weight within the longest side around it, so
  // that a triangle counts in full where it alone reaches into the picture or nearer to the eye. Allocates only where
  // there have not been as many vertices, or no criterion that asks for normals.
  void measure(const Mesh& mesh, std::span<const Vec3f> positions, const View& view, float limit,
               bool for_triangles = false);

  // [mesh.vertex_count]: the error, in the unit of the view and divided by the allowances, that a distance of 1 in the
  // units of the input is. Above 0.
  std::span<const float> weights() const { return weights_; }

 private:
  void measure_reach(const Mesh& mesh, std::span<const Vec3f> positions);
  void see_through(const Camera& camera, const View& view, float limit, std::span<const Vec3f> positions);
  void sum_area_vectors(const Mesh& mesh, std::span<const Vec3f> positions);
  void weigh_facing(const View& view, std::span<const Vec3f> positions);

  std::vector<float> weights_;
  std::vector<float> reach_;         // [vertex_count]: of the longest side around, where triangles count; otherwise 0
  std::vector<Vec3f> area_vectors_;  // [vertex_count], outwards
};

}  // namespace limber
