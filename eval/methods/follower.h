// SPDX-License-Identifier: Apache-2.0
// A hierarchy that follows the frames, and a cut through it: what the stream's reader does, without the coding.
#pragma once

#include "eval/methods/cut_mesh.h"
#include "eval/methods/method.h"
#include "limber/hierarchy/hierarchy.h"
#include "limber/hierarchy/recluster.h"

namespace limber::eval {

class Follower {
 public:
  // The mesh must outlive the follower.
  Follower(const Mesh& mesh, Hierarchy base, const ReclusterOptions& recluster, const CutOptions& cut, Index blend = 0);

  // Swaps, cut and triangles of the next frame. As CutMesh::frame().
  void frame(std::span<const Vec3f> positions, Approximation& out);

 private:
  Reclusterer reclusterer_;
  FrameState state_;
  CutMesh cut_mesh_;
};

}  // namespace limber::eval
