// SPDX-License-Identifier: Apache-2.0
// What a stream says about one frame. Part of the player: standard library only.
#pragma once

#include <cstdint>
#include <vector>

#include "limber/base/vec.h"
#include "limber/hierarchy/hierarchy.h"

namespace limber {

struct FrameState {
  std::uint32_t frame = 0;
  Hierarchy hierarchy;           // as it is at this frame
  std::vector<Vec3f> positions;  // [node_count], all levels, in the units of the input
  std::vector<float> errors;     // [node_count]; 0 for finest vertices. The square root of the node's squared error:
                                 // sqrt(area x mean squared distance), in squared units of the input, >= 0
  std::vector<Swap> swaps;       // the moves that led here from the frame before; empty at a key frame
};

}  // namespace limber
