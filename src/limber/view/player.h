// SPDX-License-Identifier: Apache-2.0
// A stream and the frame of it that is shown: step and seek.
// Part of the player: standard library only, and no allocation after open() and extend().
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "limber/base/mesh.h"
#include "limber/base/result.h"
#include "limber/stream/decoder.h"
#include "limber/stream/frame_state.h"

namespace limber {

class Player {
 public:
  // Opens a stream, or its beginning, and goes to frame 0 if that is whole. `bytes` are kept by reference until the
  // next open() or extend(). Errors: those of Decoder::open() and of decoding frame 0.
  Result<void> open(std::span<const std::byte> bytes);

  // The same stream with more of its bytes, which may lie elsewhere. The frame shown stays; where none was, it
  // becomes frame 0 if that is whole now. Errors: those of Decoder::extend() and of decoding frame 0.
  // Precondition: open() succeeded.
  Result<void> extend(std::span<const std::byte> bytes);

  // The whole stream, of which only parts may be there; see Decoder::use_index(). The frame shown stays.
  Result<bool> use_index(std::span<const std::byte> bytes) { return decoder_.use_index(bytes); }

  // Preconditions of all that follow: open() succeeded.

  const StreamHeader& header() const { return decoder_.header(); }
  const Mesh& mesh() const { return decoder_.mesh(); }
  std::uint32_t available_frames() const { return decoder_.available_frames(); }
  std::optional<std::uint32_t> frame_count() const { return decoder_.frame_count(); }

  // Precondition: frame < available_frames().
  std::uint32_t key_at_or_before(std::uint32_t frame) const { return decoder_.key_at_or_before(frame); }
  Extent extent(std::uint32_t frame) const { return decoder_.extent(frame); }

  // The frame from which seek(t) decodes onwards, t included; t + 1 where t is shown.
  // Precondition: t < available_frames().
  std::uint32_t first_decoded(std::uint32_t t) const;

  // The frame shown; frame is kNone where there is none: before the first is there, and after an error.
  const FrameState& state() const { return state_; }

  // Goes to frame t: from the nearest key at or before t, or onwards from the frame shown where that is nearer. Does
  // nothing if t is shown. After an error no frame is shown; any other seek may follow.
  // Precondition: t < available_frames(), and the bytes from first_decoded(t) to t are there.
  Result<void> seek(std::uint32_t t);

  // Goes to the frame after the one shown, or to frame 0 where none is.
  // Precondition: there is one: next_frame() < available_frames().
  Result<void> step() { return seek(next_frame()); }
  std::uint32_t next_frame() const { return state_.frame == kNone ? 0 : state_.frame + 1; }

 private:
  Decoder decoder_;
  FrameState state_;
};

}  // namespace limber
