// SPDX-License-Identifier: Apache-2.0
// The quadrics of the finest vertices for Zhang & Wu 2007, section 3.1.
#pragma once

#include <span>
#include <vector>

#include "eval/methods/method.h"
#include "limber/contract/vertex_quadrics.h"

namespace limber::eval {

class FeatureQuadrics {
 public:
  // first, last: [mesh.vertex_count], the frames that say which edges are sharp. The mesh must outlive this object.
  FeatureQuadrics(const Mesh& mesh, std::span<const Vec3f> first, std::span<const Vec3f> last,
                  const MethodOptions& options);

  // By default those of VertexQuadrics, and for each edge that is sharp in the first frame and in the last the two
  // planes on it that stand at right angles to its triangles, with the weight that a border has. As printed: the planes
  // of a vertex's triangles, all of weight 1, times the area of the triangles; and its point, as VertexQuadrics has it.
  // positions: [vertex_count], normalized; quadrics: [vertex_count], overwritten.
  void compute(std::span<const Vec3d> positions, std::span<Quadric> quadrics);

  // The edges that are held in place so.
  std::size_t crease_count() const { return creases_.size() / 2; }

 private:
  struct Crease {
    Index from, to, opposite;  // the corners of one of its triangles
  };

  void compute_literal(std::span<const Vec3d> positions, std::span<Quadric> quadrics);

  const Mesh& mesh_;
  QuadricOptions options_;
  bool literal_;
  VertexQuadrics plain_;
  std::vector<Crease> creases_;
  std::vector<double> areas_;  // [vertex_count], scratch
};

}  // namespace limber::eval
