// SPDX-License-Identifier: Apache-2.0
// Writes a four-face file, strictly forward (docs/format.md, "Four-face files").
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "limber/base/result.h"
#include "limber/fourface/four_k_mesh.h"
#include "limber/stream/encoder.h"
#include "limber/stream/four_k_header.h"

namespace limber {

struct FourKEncoderOptions {
  double tolerance = 1.0 / 20000;  // as in EncoderOptions
  bool lossless = false;
  std::uint32_t key_interval = 16;  // so many frames are decoded at most to get at one; >= 1
  std::uint32_t part_count = 1;     // >= 1
  bool first_part_last = false;     // the first part is added after all others, which are held in memory until then
  std::uint32_t frame_count = 1;    // >= 1; 1 where there are several parts
  std::uint32_t first_frame_number = 0;
  double frames_per_second = 24.0;  // finite, > 0
};

class FourKEncoder {
 public:
  explicit FourKEncoder(ByteSink sink);
  ~FourKEncoder();
  FourKEncoder(FourKEncoder&&) noexcept;
  FourKEncoder& operator=(FourKEncoder&&) noexcept;

  // box: of all positions of the first frame. input_count: of the input's vertices. Errors: of the sink; kUnsupported.
  Result<void> begin(const Box& box, Index input_count, const FourKEncoderOptions& options);

  // The next part, in its first frame. positions: [mesh.vertex_count], finite. numbers: of the vertices in the input,
  // [mesh.vertex_count], below input_count; none: as they are. Errors: of the sink; kBadInput for positions that are
  // not finite; kUnsupported where the swaps for a vertex do not stand before its removal, and for a position so far
  // away that the tolerance cannot be kept.
  Result<void> add_part(const FourKMesh& mesh, std::span<const Vec3f> positions, std::span<const Index> numbers = {});

  // The next frame of the only part, from the second on. positions: [mesh.vertex_count]; errors: [operation_count],
  // monotone. Errors: as of add_part().
  Result<void> add_frame(std::span<const Vec3f> positions, std::span<const float> errors);

  // Errors: kMismatch where there have been other numbers of parts or frames. Nothing may follow.
  Result<void> finish();

  std::uint64_t byte_count() const;  // written so far

 private:
  struct File;
  std::unique_ptr<File> file_;
};

}  // namespace limber
