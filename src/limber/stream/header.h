// SPDX-License-Identifier: Apache-2.0
// What a stream says about itself before its first frame, and the sizes of its parts. The bytes are described
// in docs/format.md. Part of the player: standard library only.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "limber/base/mesh.h"
#include "limber/base/vec.h"

namespace limber {

inline constexpr std::uint32_t kStreamVersion = 2;

struct StreamHeader {
  std::uint32_t version = kStreamVersion;
  std::optional<std::uint32_t> frame_count = std::nullopt;  // where it was known when writing began
  std::uint32_t first_frame_number = 0;                     // the number that the source gave to frame 0
  double frames_per_second = 24.0;
  Vec3d origin;                    // a stored position q, three integers, stands for the point origin + step * q
  double step = 0.0;               // quantisation step in units of the input; 0: lossless, and origin is unused
  double tolerance = 0.0;          // largest distance between an input position and the decoded one, in units of the
                                   // input; 0: lossless
  double diagonal = 0.0;           // length of the diagonal of the first frame's bounding box, in units of the input
  std::uint32_t key_interval = 0;  // no more frames than this lie between a key frame and the next, itself counted
  bool manifold_kept = false;      // the builder promises invariant `manifold-kept`
  std::vector<Index> level_begin;  // [level_count + 1], as in Hierarchy; the same for all frames
};

// The bytes of one frame by kind; their sum is what the frame takes up in the stream.
struct ChunkSizes {
  std::size_t hierarchy = 0;          // parents of a key frame, swaps of any other
  std::size_t finest_positions = 0;   // of the finest vertices
  std::size_t coarser_positions = 0;  // of the nodes above them
  std::size_t errors = 0;
  std::size_t overhead = 0;  // lengths and checksums

  std::size_t total() const { return hierarchy + finest_positions + coarser_positions + errors + overhead; }
};

}  // namespace limber
