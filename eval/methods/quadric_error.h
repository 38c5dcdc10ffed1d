// SPDX-License-Identifier: Apache-2.0
// The quadric error of any clustering, computed in one way for all methods.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "limber/base/mesh.h"
#include "limber/base/quadric.h"
#include "limber/base/vec.h"
#include "limber/contract/vertex_quadrics.h"

namespace limber::eval {

class QuadricError {
 public:
  // The mesh must outlive this object.
  QuadricError(const Mesh& mesh, const QuadricOptions& options);

  // The sum over the clusters of the smallest value of the sum of their vertices' quadrics, relative to the fourth
  // power of the diagonal of this frame's bounding box. `clusters` is [vertex_count]: equal numbers share a cluster.
  double measure(std::span<const Vec3f> positions, std::span<const Index> clusters);

 private:
  Index vertex_count_;
  VertexQuadrics vertex_quadrics_;
  std::vector<Vec3d> unit_;        // [vertex_count], scratch, as all that follow
  std::vector<Quadric> quadrics_;  // [vertex_count]
  std::vector<Quadric> sums_;
};

}  // namespace limber::eval
