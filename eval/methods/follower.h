// SPDX-License-Identifier: Apache-2.0
// A hierarchy that follows the frames, and a cut through it: what the stream's reader does, without the coding.
#pragma once

#include <optional>

#include "eval/methods/method.h"
#include "limber/hierarchy/hierarchy.h"
#include "limber/hierarchy/recluster.h"
#include "limber/view/cut.h"
#include "limber/view/extract.h"

namespace limber::eval {

class Follower {
 public:
  // The mesh must outlive the follower.
  Follower(const Mesh& mesh, Hierarchy base, const ReclusterOptions& recluster, const CutOptions& cut);

  // Swaps, cut and triangles of the next frame. Nodes are those of the hierarchy.
  void frame(std::span<const Vec3f> positions, Approximation& out);

 private:
  const Mesh& mesh_;
  Reclusterer reclusterer_;
  FrameState state_;
  Cut cut_;
  ExtractScratch scratch_;
  MeshBuffers buffers_;
};

}  // namespace limber::eval
