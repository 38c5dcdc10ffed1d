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
  // > 0 (see View). Allocates only where there have not been as many vertices, or no criterion that asks for normals.
  void measure(const Mesh& mesh, std::span<const Vec3f> positions, const View& view, float limit);

  // [mesh.vertex_count]: the error, in the unit of the view and divided by the allowances, that a distance of 1 in the
  // units of the input is. Above 0.
  std::span<const float> weights() const { return weights_; }

 private:
  void see_through(const Camera& camera, const View& view, float limit, std::span<const Vec3f> positions);
  void sum_area_vectors(const Mesh& mesh, std::span<const Vec3f> positions);
  void weigh_facing(const View& view, std::span<const Vec3f> positions);

  std::vector<float> weights_;
  std::vector<Vec3f> area_vectors_;  // [vertex_count], outwards
};

}  // namespace limber
