// SPDX-License-Identifier: Apache-2.0
#include "limber/stream/chunk.h"

#include <cmath>
#include <limits>

namespace limber {
namespace {

Error bad(std::uint64_t offset, const char* what) { return {ErrorCode::kBadInput, place_in_stream(offset), what}; }

bool all_finite(const StreamHeader& h) {
  return std::isfinite(h.frames_per_second) && is_finite(h.origin) && std::isfinite(h.step) &&
         std::isfinite(h.tolerance) && std::isfinite(h.diagonal);
}

// Every lattice point must be a finite float.
bool lattice_is_finite(const StreamHeader& h) {
  constexpr double kMost = std::numeric_limits<float>::max();
  const double reach = h.step * 2147483648.0;
  return std::fabs(h.origin.x) + reach < kMost && std::fabs(h.origin.y) + reach < kMost &&
         std::fabs(h.origin.z) + reach < kMost;
}

}  // namespace

std::vector<std::byte> chunk_header(std::uint32_t kind, std::uint32_t number, std::span<const std::byte> payload) {
  std::vector<std::byte> bytes;
  append_little_endian(bytes, kind);
  append_little_endian(bytes, number);
  append_little_endian(bytes, static_cast<std::uint32_t>(payload.size()));
  append_little_endian(bytes, crc32c(payload));
  append_little_endian(bytes, crc32c(bytes));
  return bytes;
}

std::string place_in_stream(std::uint64_t offset, std::optional<std::uint32_t> frame) {
  const std::string byte = "byte " + std::to_string(offset);
  return frame ? "frame " + std::to_string(*frame) + ", " + byte : byte;
}

Result<ChunkHeader> read_chunk_header(std::span<const std::byte> bytes, std::uint64_t offset) {
  if (bytes.size() - offset < kChunkHeaderSize)
    return Error{ErrorCode::kTruncated, place_in_stream(offset), "the stream ends within the header of a chunk"};
  const auto raw = bytes.subspan(static_cast<std::size_t>(offset), kChunkHeaderSize);
  if (crc32c(raw.first(kChunkHeaderSize - 4)) != load_little_endian<std::uint32_t>(&raw[kChunkHeaderSize - 4]))
    return bad(offset, "the header of a chunk does not match its checksum; the stream is damaged here");
  FieldReader fields(raw);
  ChunkHeader header;
  header.kind = fields.u32();
  header.number = fields.u32();
  header.length = fields.u32();
  header.payload_check = fields.u32();
  return header;
}

bool chunk_is_whole(std::span<const std::byte> bytes, std::uint64_t offset, const ChunkHeader& header) {
  return bytes.size() - offset - kChunkHeaderSize >= header.length;
}

Result<std::span<const std::byte>> read_payload(std::span<const std::byte> bytes, std::uint64_t offset,
                                                const ChunkHeader& header) {
  const auto payload = bytes.subspan(static_cast<std::size_t>(offset) + kChunkHeaderSize, header.length);
  if (crc32c(payload) != header.payload_check)
    return bad(offset, "a chunk does not match its checksum; the stream is damaged here");
  return payload;
}

Result<StreamHeader> read_stream_header(std::span<const std::byte> payload, std::uint64_t offset,
                                        std::uint32_t& triangle_count) {
  FieldReader fields(payload);
  StreamHeader h;
  const std::uint32_t flags = fields.u32();
  const std::uint32_t frame_count = fields.u32();
  h.first_frame_number = fields.u32();
  h.key_interval = fields.u32();
  h.frames_per_second = fields.f64();
  h.origin.x = fields.f64();
  h.origin.y = fields.f64();
  h.origin.z = fields.f64();
  h.step = fields.f64();
  h.tolerance = fields.f64();
  h.diagonal = fields.f64();
  triangle_count = fields.u32();
  const std::uint32_t level_count = fields.u32();
  if (fields.overrun()) return bad(offset, "the header chunk is too short");
  if (flags > 3)
    return Error{ErrorCode::kUnsupported, place_in_stream(offset),
                 "the header has flags unknown to this version of limber"};
  h.manifold_kept = (flags & 1) != 0;
  if ((flags & 2) != 0) h.frame_count = frame_count;
  if (!all_finite(h) || h.frames_per_second <= 0 || h.step < 0 || h.tolerance < 0 || h.diagonal < 0 ||
      !lattice_is_finite(h) || h.key_interval == 0)
    return bad(offset, "the header has a field outside its range");
  if (level_count == 0 || level_count > kMostLevels || fields.left() != 4 * std::size_t{level_count})
    return bad(offset, "the header does not list its levels");
  h.level_begin.push_back(0);
  for (std::uint32_t level = 0; level < level_count; ++level) {
    const std::uint32_t end = fields.u32();
    if (end <= h.level_begin.back() || end > kMostNodes)
      return bad(offset, "the levels of the header are not in order, empty, or too large");
    h.level_begin.push_back(end);
  }
  if (triangle_count > kMostTriangles) return bad(offset, "the header announces too many triangles");
  return h;
}

}  // namespace limber
