// SPDX-License-Identifier: Apache-2.0
// What a four-face file says about itself (docs/format.md, "Four-face files").
#pragma once

#include <cstdint>

#include "limber/base/mesh.h"
#include "limber/base/vec.h"
#include "limber/stream/chunk.h"

namespace limber {

inline constexpr std::uint32_t kFourKChunk = chunk_kind('F', 'O', 'U', 'R');   // the header
inline constexpr std::uint32_t kPartChunk = chunk_kind('P', 'A', 'R', 'T');    // a coarsest mesh
inline constexpr std::uint32_t kRefineChunk = chunk_kind('F', 'I', 'N', 'E');  // clusters, coarse to fine
inline constexpr std::uint32_t kPoseChunk = chunk_kind('P', 'O', 'S', 'E');    // another frame
inline constexpr std::uint32_t kFourKEndChunk = chunk_kind('D', 'O', 'N', 'E');

// So many vertices and triangles of a coarsest mesh may a byte of its chunk stand for, and so many operations a byte of
// theirs.
inline constexpr std::uint64_t kMostOperationsPerByte = 2;

struct FourKHeader {
  std::uint32_t part_count = 1;   // >= 1; more than one: the parts of a mesh that was simplified out of core
  std::uint32_t frame_count = 1;  // >= 1; 1 where there are several parts
  std::uint32_t first_frame_number = 0;
  double frames_per_second = 24.0;
  Vec3d origin;  // as in StreamHeader
  double step = 0.0;
  double tolerance = 0.0;
  double diagonal = 0.0;
  Index vertex_count = 0;  // of the input: what the numbers of vertices are below
};

}  // namespace limber
