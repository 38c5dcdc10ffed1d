// SPDX-License-Identifier: Apache-2.0
// Writes a stream, strictly forward, holding one frame in memory (docs/format.md).
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>

#include "limber/base/mesh.h"
#include "limber/base/result.h"
#include "limber/base/vec.h"
#include "limber/hierarchy/hierarchy.h"
#include "limber/hierarchy/leeway.h"
#include "limber/stream/header.h"

namespace limber {

// Takes the next bytes of the stream; an error ends the encoding.
using ByteSink = std::function<Result<void>(std::span<const std::byte>)>;

struct EncoderOptions {
  double tolerance = 1.0 / 20000;   // largest distance between a vertex of the input and the decoded one, relative to
                                    // the diagonal of the first frame's bounding box; > 0
  bool lossless = false;            // every float as it was, bit by bit; `tolerance` is then unused
  std::uint32_t key_interval = 64;  // every so many frames one that can be decoded alone; >= 1
  std::uint32_t first_frame_number = 0;
  double frames_per_second = 24.0;                          // finite, > 0
  std::optional<std::uint32_t> frame_count = std::nullopt;  // where known
  bool manifold_kept = true;                                // the hierarchies keep invariant `manifold-kept`
};

class Encoder {
 public:
  explicit Encoder(ByteSink sink);
  ~Encoder();
  Encoder(Encoder&&) noexcept;
  Encoder& operator=(Encoder&&) noexcept;

  // Writes header and mesh. `base` gives the levels, `first_positions` ([vertex_count], finite) the bounding box.
  // A clip without extent is written losslessly. Errors: those of the sink; kUnsupported beyond the format's limits.
  Result<void> begin(const Mesh& mesh, const Hierarchy& base, std::span<const Vec3f> first_positions,
                     const EncoderOptions& options);

  // Writes the next frame. `hierarchy` is as it is at this frame; `net_swaps` leads to it from the frame before:
  // each node at most once, in any order, every one a change (ignored at key frames). `positions` and `errors`
  // are [node_count], errors finite and >= 0. Frame 0, every key_interval-th frame and, with `force_key`, this
  // frame are keys. Decoded errors are within 1/16 of these, 0 stays 0; those of finest vertices are taken to be 0.
  // `leeways`: none, or [node_count - vertex_count]: nodes above the finest level may then be displaced within theirs,
  // to where they take fewer bytes, and by the rounding to the lattice; without, and in a lossless stream, they are
  // kept within the tolerance as the finest are. Errors: those of the sink; kBadInput for a position that is not
  // finite; kUnsupported for one so far away that the tolerance cannot be kept.
  Result<void> add(const Hierarchy& hierarchy, std::span<const Swap> net_swaps, std::span<const Vec3f> positions,
                   std::span<const float> errors, std::span<const Leeway> leeways = {}, bool force_key = false);

  // The bytes of the frame added last, by kind.
  const ChunkSizes& sizes() const;

  // Writes the index. Error kMismatch: options.frame_count was another number. Nothing may be added afterwards.
  Result<void> finish();

 private:
  struct Stream;
  std::unique_ptr<Stream> stream_;
};

}  // namespace limber
