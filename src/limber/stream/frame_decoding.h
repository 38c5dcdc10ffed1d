// SPDX-License-Identifier: Apache-2.0
// The sections of one frame's chunk (docs/format.md, "KEYF and STEP"), decoded. Part of the player.
#pragma once

#include <cstddef>
#include <span>

#include "limber/stream/coding_state.h"
#include "limber/stream/frame_state.h"
#include "limber/stream/quantizer.h"

namespace limber {

// Parents and swaps. False where the bytes are wrong.
bool decode_hierarchy_section(CodingState& coding, bool key, std::span<const std::byte> section, FrameState& state);

struct PositionSections {
  std::span<const std::byte> finest, coarser, errors;
};

// Positions and errors; the hierarchy is that of the frame. Gives the rule that the bytes break, or null.
const char* decode_position_sections(CodingState& coding, const Quantizer& quantizer, bool key,
                                     const PositionSections& sections, FrameState& state);

}  // namespace limber
