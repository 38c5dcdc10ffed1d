// SPDX-License-Identifier: Apache-2.0
// A four-face file at one of its frames.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "limber/base/result.h"
#include "limber/stream/four_k_decoder.h"

namespace limber {

class FourKClip {
 public:
  // `bytes` are kept by reference. At the first frame of the first part. Errors: those of FourKDecoder.
  Result<void> open(std::span<const std::byte> bytes);

  const FourKDecoder& decoder() const { return decoder_; }
  const FourKMesh& mesh() const { return part_.mesh; }  // with errors and radii of this frame; the same object always
  std::span<const Vec3f> positions() const { return part_.positions; }
  std::span<const Index> numbers() const { return part_.numbers; }
  bool is_whole() const { return part_.is_whole; }
  std::uint32_t frame() const { return frame_; }

  // Precondition: frame < decoder().frame_count(). Onwards by one frame it takes one, else at most as many as there are
  // between keys. After an error the clip is at no frame, and can only be opened again.
  Result<void> go_to(std::uint32_t frame);

 private:
  void go_to_first();

  FourKDecoder decoder_;
  FourKPart part_;
  FourKPoseBase base_;
  std::uint32_t frame_ = 0;
  std::vector<Lattice> at_, next_;
  std::vector<std::int32_t> errors_;
};

}  // namespace limber
