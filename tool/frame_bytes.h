// SPDX-License-Identifier: Apache-2.0
// The bytes of frames by kind, as all verbs report them.
#pragma once

#include <cstdint>
#include <string>

#include "limber/stream/header.h"
#include "tool/console.h"

namespace limber::tool {

// Adds up, kind by kind.
ChunkSizes& operator+=(ChunkSizes& sum, const ChunkSizes& sizes);

// Of the sum over so many frames, the mean per frame.
std::string frame_bytes_line(const ChunkSizes& sum, std::uint32_t frame_count);
Json frame_bytes_json(const ChunkSizes& sum, std::uint32_t frame_count);

// 0 where there are no vertices or frames.
double bits_per_vertex(std::uint64_t bytes, Index vertex_count, std::uint32_t frame_count);

}  // namespace limber::tool
