// SPDX-License-Identifier: Apache-2.0
// The mesh of a cut through a frame's hierarchy, as an approximation.
#pragma once

#include <optional>

#include "eval/methods/method.h"
#include "limber/stream/frame_state.h"
#include "limber/view/blend.h"
#include "limber/view/cut.h"
#include "limber/view/extract.h"

namespace limber::eval {

class CutMesh {
 public:
  // The mesh must outlive this object. `blend`: over how many frames a change is blended.
  CutMesh(const Mesh& mesh, const Hierarchy& hierarchy, const CutOptions& cut, Index blend = 0);

  // All of the approximation but adapt_seconds. Nodes are those of the hierarchy, and then moving vertices; clusters
  // are those of the cut.
  void frame(const FrameState& state, Approximation& out);

 private:
  const Mesh& mesh_;
  Cut cut_;
  std::optional<Blend> blend_;  // where changes are blended
  ExtractScratch scratch_;
  MeshBuffers buffers_;
};

// The cut that has the size that the methods are asked for.
CutOptions cut_to_size(const MethodOptions& options);

}  // namespace limber::eval
