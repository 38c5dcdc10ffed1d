// SPDX-License-Identifier: Apache-2.0
#include "limber/view/player.h"

#include <cassert>

namespace limber {

Result<void> Player::open(std::span<const std::byte> bytes) {
  state_.frame = kNone;
  if (Result<void> opened = decoder_.open(bytes); !opened) return opened;
  decoder_.prepare(state_);
  if (available_frames() == 0) return {};
  return seek(0);
}

Result<void> Player::extend(std::span<const std::byte> bytes) {
  if (Result<void> extended = decoder_.extend(bytes); !extended) return extended;
  if (state_.frame != kNone || available_frames() == 0) return {};
  return seek(0);
}

std::uint32_t Player::first_decoded(std::uint32_t t) const {
  assert(t < available_frames());
  const std::uint32_t key = decoder_.key_at_or_before(t);
  const bool onwards = state_.frame != kNone && key <= state_.frame && state_.frame <= t;
  return onwards ? state_.frame + 1 : key;
}

Result<void> Player::seek(std::uint32_t t) {
  for (std::uint32_t frame = first_decoded(t); frame <= t; ++frame) {
    if (Result<void> decoded = decoder_.decode(frame, state_); !decoded) {
      state_.frame = kNone;
      return decoded;
    }
  }
  return {};
}

}  // namespace limber
