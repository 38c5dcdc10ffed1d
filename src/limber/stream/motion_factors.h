// SPDX-License-Identifier: Apache-2.0
// What the encoder chooses for each frame.
#pragma once

#include <span>

#include "limber/stream/coarser_positions.h"
#include "limber/stream/finest_positions.h"

namespace limber {

// The factors with which the frame `actual` ([vertex_count], by place), that follows the one in `finest`, is
// predicted best: of the smallest sum of absolute residuals, about, by least squares with weights 1 / |residual|.
MotionFactors best_motion_factors(const Traversal& traversal, FinestPositions& finest, std::span<const Lattice> actual);

}  // namespace limber
