// SPDX-License-Identifier: Apache-2.0
// The skeleton of a stream: magic, chunks, end mark (docs/format.md). Part of the player.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "limber/base/result.h"
#include "limber/stream/bytes.h"
#include "limber/stream/crc32c.h"
#include "limber/stream/header.h"

namespace limber {

// The first byte is not ASCII and a line end of each kind follows: transfers that change text are noticed.
inline constexpr std::array<std::uint8_t, 8> kMagic{0x89, 'L', 'M', 'B', 'R', 0x0d, 0x0a, 0x1a};
inline constexpr std::array<std::uint8_t, 8> kEndMagic{'L', 'M', 'B', 'R', '-', 'e', 'n', 'd'};

inline constexpr std::size_t kPreambleSize = 12;  // magic, version
inline constexpr std::size_t kChunkHeaderSize = 20;
inline constexpr std::size_t kEndMarkSize = 16;  // offset of the index chunk, magic
inline constexpr std::size_t kSectionCount = 4;  // hierarchy, finest positions, coarser positions, errors
inline constexpr std::size_t kSectionTableSize = 4 * kSectionCount;

// Limits of what may be declared (docs/format.md, "Limits").
inline constexpr std::uint32_t kMostNodes = 1u << 28;
inline constexpr std::uint32_t kMostTriangles = 1u << 29;
inline constexpr std::uint32_t kMostLevels = 32;

// Nodes and triangles that one byte of the mesh chunk may stand for.
inline constexpr std::uint64_t kMostPerMeshByte = 4;

constexpr std::uint32_t chunk_kind(char a, char b, char c, char d) {
  return static_cast<std::uint32_t>(static_cast<unsigned char>(a)) |
         static_cast<std::uint32_t>(static_cast<unsigned char>(b)) << 8 |
         static_cast<std::uint32_t>(static_cast<unsigned char>(c)) << 16 |
         static_cast<std::uint32_t>(static_cast<unsigned char>(d)) << 24;
}

inline constexpr std::uint32_t kHeaderChunk = chunk_kind('H', 'E', 'A', 'D');
inline constexpr std::uint32_t kMeshChunk = chunk_kind('M', 'E', 'S', 'H');
inline constexpr std::uint32_t kKeyChunk = chunk_kind('K', 'E', 'Y', 'F');
inline constexpr std::uint32_t kStepChunk = chunk_kind('S', 'T', 'E', 'P');
inline constexpr std::uint32_t kIndexChunk = chunk_kind('I', 'N', 'D', 'X');

// A chunk whose kind begins with a small letter may be skipped by who does not know it.
constexpr bool is_optional(std::uint32_t kind) { return (kind & 0x20) != 0; }

struct ChunkHeader {
  std::uint32_t kind = 0;
  std::uint32_t number = 0;  // the frame of a key or step chunk, else 0
  std::uint32_t length = 0;  // of the payload
  std::uint32_t payload_check = 0;
};

// The header of a chunk with this payload, which is shorter than 4 GiB.
std::vector<std::byte> chunk_header(std::uint32_t kind, std::uint32_t number, std::span<const std::byte> payload);

// "frame 3, byte 1234": where in a stream an error lies.
std::string place_in_stream(std::uint64_t offset, std::optional<std::uint32_t> frame = {});

// Precondition: offset <= bytes.size(). kTruncated where the chunk's header is not whole, kBadInput where its
// checksum is wrong.
Result<ChunkHeader> read_chunk_header(std::span<const std::byte> bytes, std::uint64_t offset);

// Whether header and payload are there.
bool chunk_is_whole(std::span<const std::byte> bytes, std::uint64_t offset, const ChunkHeader& header);

// Precondition: chunk_is_whole(). kBadInput where the checksum is wrong.
Result<std::span<const std::byte>> read_payload(std::span<const std::byte> bytes, std::uint64_t offset,
                                                const ChunkHeader& header);

// The payload of the header chunk, every field within its limits.
Result<StreamHeader> read_stream_header(std::span<const std::byte> payload, std::uint64_t offset,
                                        std::uint32_t& triangle_count);

}  // namespace limber
