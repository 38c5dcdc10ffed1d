// SPDX-License-Identifier: Apache-2.0
#include "limber/stream/four_k_clip.h"

#include <cassert>
#include <utility>

#include "limber/fourface/record.h"
#include "limber/stream/error_coding.h"

namespace limber {

Result<void> FourKClip::open(std::span<const std::byte> bytes) {
  if (Result<void> opened = decoder_.open(bytes); !opened) return opened;
  Result<FourKPart> part = decoder_.read_part(0, &base_);
  if (!part) return part.error();
  part_ = std::move(*part);
  next_.resize(base_.positions.size());
  go_to_first();
  return {};
}

void FourKClip::go_to_first() {
  frame_ = 0;
  at_ = base_.positions;
  errors_ = base_.errors;
}

Result<void> FourKClip::go_to(std::uint32_t frame) {
  assert(frame < decoder_.frame_count());
  if (frame == frame_) return {};
  std::vector<std::uint32_t> path;  // backwards
  for (std::uint32_t at = frame; at != frame_ && at != 0;) {
    path.push_back(at);
    const Result<std::uint32_t> from = decoder_.builds_on(at);
    if (!from) return from.error();
    at = *from;
    if (at == 0) go_to_first();
  }
  if (path.empty()) go_to_first();
  for (std::size_t i = path.size(); i-- > 0;) {
    if (Result<void> read = decoder_.read_pose(path[i], base_, at_, next_, errors_); !read) return read;
    std::swap(at_, next_);
  }
  frame_ = frame;
  const Quantizer lattice = decoder_.quantizer();
  for (std::size_t v = 0; v < at_.size(); ++v) {
    part_.positions[v] = lattice.position(at_[v]);
    if (!is_finite(part_.positions[v]))
      return Error{ErrorCode::kBadInput, "frame " + std::to_string(frame), "a position is not a finite number"};
  }
  const std::size_t count = errors_.size();
  for (std::size_t i = 0; i < count; ++i) part_.mesh.error[count - 1 - i] = error_value(errors_[i]);
  make_monotone(part_.mesh, part_.positions, 1);
  return {};
}

}  // namespace limber
