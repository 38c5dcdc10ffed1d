// SPDX-License-Identifier: Apache-2.0
// One clustering for the whole clip, its vertices placed anew in every frame: what methods of static connectivity
// share.
//
//   frame:  quadrics of the vertices, summed over the clusters; a vertex where each sum is smallest
#pragma once

#include <span>
#include <vector>

#include "eval/methods/method.h"
#include "limber/contract/vertex_quadrics.h"

namespace limber::eval {

class StaticClusters {
 public:
  // What the contractor has come to, which need not live on; the mesh must. `first`: the first frame of the clip, whose
  // size all frames are normalized by.
  StaticClusters(const Mesh& mesh, const Contractor& contractor, std::span<const Vec3f> first,
                 const QuadricOptions& quadrics);

  // All of the approximation of a frame; [vertex_count], finite.
  void frame(std::span<const Vec3f> positions, Approximation& out);

  // The clusters that have triangles: what approximations are made of.
  Index size() const { return static_cast<Index>(simplified_.vertices.size()); }
  // [vertex_count]: which of them a vertex belongs to; kNone where its cluster has no triangles.
  std::span<const Index> cluster_of() const { return cluster_of_; }
  // The sum of the quadrics of each cluster in a frame, [size()], valid until the next call; normalized by `normalize`,
  // which is set.
  std::span<const Quadric> sum_quadrics(std::span<const Vec3f> positions, Normalization& normalize);
  // Triangles, nodes and clusters of every frame.
  void connect(Approximation& out) const;

 private:
  const Mesh& mesh_;
  Simplified simplified_;
  double scale_;                     // of the first frame's normalization, used for all
  std::vector<Index> clusters_;      // [vertex_count]: the representative
  std::vector<Index> cluster_of_;    // [vertex_count]
  std::vector<Index> member_count_;  // [size()]
  VertexQuadrics vertex_quadrics_;
  std::vector<Vec3d> unit_;  // [vertex_count], scratch, as the next two
  std::vector<Quadric> quadrics_;
  std::vector<Quadric> sums_;  // [size()]
};

}  // namespace limber::eval
