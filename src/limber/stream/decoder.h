// SPDX-License-Identifier: Apache-2.0
// Reads a stream from memory, while it is still arriving or whole, frame by frame (docs/format.md).
// Part of the player: standard library only, and no allocation after open(), extend() and prepare().
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "limber/base/mesh.h"
#include "limber/base/result.h"
#include "limber/stream/frame_state.h"
#include "limber/stream/header.h"

namespace limber {

// Bytes of a stream: from `begin` up to, without, `end`.
struct Extent {
  std::uint64_t begin = 0, end = 0;

  friend bool operator==(const Extent&, const Extent&) = default;
};

// Holds what is needed to decode the frame after the one decoded last: one frame of memory.
// An Error says in `where` the frame and the byte of the stream at which a rule is broken.
class Decoder {
 public:
  Decoder();
  ~Decoder();
  Decoder(Decoder&&) noexcept;
  Decoder& operator=(Decoder&&) noexcept;

  // `bytes`: a stream, or its beginning; kept by reference, so they must live and stay as they are until the
  // next open() or extend(). Error kTruncated: not even header and mesh are whole yet; open again with more.
  // Other errors: kBadInput, kUnsupported (a version or a needed chunk that this decoder does not know).
  // After an error the decoder is as it was when made.
  Result<void> open(std::span<const std::byte> bytes);

  // The same stream, at least as long as before; may lie elsewhere. Decoding goes on where it was.
  // Precondition: open() succeeded. After an error the decoder is as it was before the call, on the old bytes.
  Result<void> extend(std::span<const std::byte> bytes);

  // For random access where not all bytes are there yet. `bytes` has the length of the whole stream; of its content
  // only what earlier calls were given and the end, from the index chunk on, need be there. Gives false, and changes
  // nothing, where no index stands at the end; else all frames are available, but only those whose extent() is there
  // may be decoded. Precondition: open() succeeded. Error: the index is damaged, or not that of this stream.
  Result<bool> use_index(std::span<const std::byte> bytes);

  // Precondition of all that follow: open() succeeded.

  const StreamHeader& header() const;
  const Mesh& mesh() const;

  // Frames 0 to available_frames() - 1 are whole in the bytes present (their checksums are tested when decoded).
  std::uint32_t available_frames() const;

  // The number of frames of the whole stream: from the header, or from the index once that has arrived.
  std::optional<std::uint32_t> frame_count() const;

  // Precondition of the next four: frame < available_frames().
  bool is_key(std::uint32_t frame) const;
  std::uint32_t key_at_or_before(std::uint32_t frame) const;  // frame 0 is always a key
  ChunkSizes sizes(std::uint32_t frame) const;
  Extent extent(std::uint32_t frame) const;  // of its chunk, and of optional chunks after it

  // Gives all arrays of `state` their final sizes and capacities; state.frame becomes kNone.
  void prepare(FrameState& state) const;

  // Parents and swaps of the frame; sets state.frame.
  // Precondition: state was prepared; frame < available_frames(); and frame is a key, or state is what this
  // decoder decoded last, and that was frame - 1. After an error go on from a key frame.
  Result<void> decode_hierarchy(std::uint32_t frame, FrameState& state);

  // Positions and errors of the frame. Precondition: decode_hierarchy(frame, state) was the call before.
  Result<void> decode_positions(std::uint32_t frame, FrameState& state);

  // Both.
  Result<void> decode(std::uint32_t frame, FrameState& state);

 private:
  struct Stream;
  std::unique_ptr<Stream> stream_;
};

}  // namespace limber
