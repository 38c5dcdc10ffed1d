// SPDX-License-Identifier: Apache-2.0
#include "limber/stream/four_k_decoder.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <utility>

#include "limber/fourface/record.h"
#include "limber/stream/four_k_coding.h"
#include "limber/stream/mesh_coding.h"

namespace limber {
namespace {

Error bad(std::uint64_t offset, const char* what) { return {ErrorCode::kBadInput, place_in_stream(offset), what}; }

Error truncated(std::uint64_t offset) {
  return {ErrorCode::kTruncated, place_in_stream(offset), "the file ends before its first mesh; copy it again"};
}

bool starts_like(std::span<const std::byte> bytes, std::span<const std::uint8_t> expected) {
  const std::size_t count = std::min(bytes.size(), expected.size());
  return count == 0 || std::memcmp(bytes.data(), expected.data(), count) == 0;
}

bool reaches_beyond_floats(const FourKHeader& h) {
  constexpr double kMost = std::numeric_limits<float>::max();
  const double reach = h.step * 2147483648.0;
  for (const double x : {h.origin.x, h.origin.y, h.origin.z})
    if (!(std::fabs(x) + reach < kMost)) return true;
  return false;
}

Result<FourKHeader> read_header(std::span<const std::byte> payload, std::uint64_t offset) {
  FieldReader fields(payload);
  FourKHeader h;
  const std::uint32_t flags = fields.u32();
  h.part_count = fields.u32();
  h.frame_count = fields.u32();
  h.first_frame_number = fields.u32();
  for (double* const x :
       {&h.frames_per_second, &h.origin.x, &h.origin.y, &h.origin.z, &h.step, &h.tolerance, &h.diagonal}) {
    *x = fields.f64();
    if (!std::isfinite(*x)) return bad(offset, "the header has a field outside its range");
  }
  h.vertex_count = fields.u32();
  if (fields.overrun() || fields.left() != 0) return bad(offset, "the header does not have its length");
  if (flags != 0)
    return Error{ErrorCode::kUnsupported, place_in_stream(offset),
                 "the header has flags unknown to this version of limber"};
  if (h.part_count == 0 || h.frame_count == 0 || (h.part_count > 1 && h.frame_count > 1) ||
      !(h.frames_per_second > 0) || h.step < 0 || h.tolerance < 0 || h.diagonal < 0 || reaches_beyond_floats(h) ||
      h.vertex_count > kMostNodes)
    return bad(offset, "the header has a field outside its range");
  return h;
}

}  // namespace

bool is_four_face_file(std::span<const std::byte> bytes) {
  if (!starts_like(bytes, kMagic) || bytes.size() < kPreambleSize + 4) return false;
  return load_little_endian<std::uint32_t>(&bytes[kPreambleSize]) == kFourKChunk;
}

struct FourKDecoder::PartState {
  FourKGrowth growth;
  std::vector<Lattice> lattice;
  std::vector<Index> numbers;
  std::vector<std::int32_t> errors;  // the last operation first
  Index operation_count = 0;         // of the whole part
  std::vector<Index> level_ends;
  FourKCoding<RangeDecoder>::Models models;
};

std::uint32_t FourKDecoder::frame_count() const { return static_cast<std::uint32_t>(poses_.size()) + 1; }

Result<void> FourKDecoder::open(std::span<const std::byte> bytes) {
  *this = FourKDecoder();
  bytes_ = bytes;
  if (!starts_like(bytes, kMagic)) return bad(0, "not a .limber file: its first bytes are others");
  if (bytes.size() < kPreambleSize) return truncated(bytes.size());
  const auto version = load_little_endian<std::uint32_t>(&bytes[kMagic.size()]);
  if (version != kStreamVersion)
    return Error{ErrorCode::kUnsupported, place_in_stream(kMagic.size()),
                 "version " + std::to_string(version) + " of the format; this limber reads version " +
                     std::to_string(kStreamVersion)};
  const auto chunk = read_chunk_header(bytes, kPreambleSize);
  if (!chunk) return chunk.error();
  if (chunk->kind != kFourKChunk || chunk->number != 0)
    return bad(kPreambleSize, "not a four-face file: its header is of another kind");
  if (!chunk_is_whole(bytes, kPreambleSize, *chunk)) return truncated(bytes.size());
  const auto payload = payload_at(kPreambleSize);
  if (!payload) return payload.error();
  const auto header = read_header(*payload, kPreambleSize);
  if (!header) return header.error();
  header_ = *header;
  if (Result<void> scanned = scan(kPreambleSize + kChunkHeaderSize + chunk->length); !scanned) return scanned;
  return parts_.empty() ? Result<void>(truncated(bytes.size())) : Result<void>();
}

// What chunks there are, from their headers alone.
Result<void> FourKDecoder::scan(std::uint64_t offset) {
  while (bytes_.size() - offset >= kChunkHeaderSize) {
    const auto chunk = read_chunk_header(bytes_, offset);
    if (!chunk) return chunk.error();
    if (!chunk_is_whole(bytes_, offset, *chunk)) return {};
    const std::uint64_t behind = offset + kChunkHeaderSize + chunk->length;
    if (chunk->kind == kPartChunk) {
      if (chunk->number != parts_.size() || chunk->number >= header_.part_count)
        return bad(offset, "the parts are not in order");
      parts_.push_back({.offset = offset, .byte_count = 0, .chunks = {}});
    } else if (chunk->kind == kRefineChunk) {
      if (parts_.empty() || chunk->number != parts_.back().chunks.size() || !poses_.empty())
        return bad(offset, "the clusters are not in order");
      parts_.back().chunks.push_back(offset);
    } else if (chunk->kind == kPoseChunk) {
      if (parts_.empty() || chunk->number != frame_count() || chunk->number >= header_.frame_count)
        return bad(offset, "the frames are not in order");
      poses_.push_back(offset);
    } else if (chunk->kind == kFourKEndChunk) {
      if (part_count() != header_.part_count || frame_count() != header_.frame_count || chunk->length != 0 ||
          chunk->number != 0)
        return bad(offset, "the file ends without all that its header announces");
      std::array<std::uint8_t, kEndMarkSize> expected;
      for (std::size_t i = 0; i < 8; ++i) expected[i] = static_cast<std::uint8_t>(offset >> (8 * i));
      std::copy(kEndMagic.begin(), kEndMagic.end(), expected.begin() + 8);
      const auto rest = bytes_.subspan(static_cast<std::size_t>(behind));
      if (!starts_like(rest, expected) || rest.size() > kEndMarkSize)
        return bad(behind, "the end of the file is damaged");
      is_whole_ = rest.size() == kEndMarkSize;
      return {};
    } else if (!is_optional(chunk->kind)) {
      return Error{ErrorCode::kUnsupported, place_in_stream(offset),
                   "a chunk of a kind that this limber does not know; it needs a newer one"};
    }
    if (!parts_.empty() && poses_.empty()) parts_.back().byte_count += behind - offset;
    offset = behind;
  }
  return {};
}

Result<std::span<const std::byte>> FourKDecoder::payload_at(std::uint64_t offset) const {
  const auto chunk = read_chunk_header(bytes_, offset);
  if (!chunk) return chunk.error();
  return read_payload(bytes_, offset, *chunk);
}

Result<void> FourKDecoder::read_coarsest(std::uint64_t offset, PartState& state) const {
  const auto payload = payload_at(offset);
  if (!payload) return payload.error();
  FieldReader fields(*payload);
  const Index vertex_count = fields.u32(), triangle_count = fields.u32();
  state.operation_count = fields.u32();
  const std::uint32_t level_count = fields.u32();
  if (fields.overrun() || fields.left() / 4 < level_count || state.operation_count > kMostTriangles)
    return bad(offset, "a part does not list its levels");
  Index before = 0;
  for (std::uint32_t level = 0; level < level_count; ++level) {
    const Index end = fields.u32();
    if (end <= before || end > state.operation_count) return bad(offset, "the levels of a part are not in order");
    state.level_ends.push_back(before = end);
  }
  if (before != state.operation_count) return bad(offset, "the levels of a part are not its operations");
  if (std::uint64_t{vertex_count} + triangle_count > kMostPerMeshByte * fields.left())
    return bad(offset, "a part is too short for the coarsest mesh that it announces");
  RangeDecoder coder(payload->last(fields.left()));
  MeshCoding<RangeDecoder> meshes(coder, vertex_count, triangle_count);
  for (Index v = 0; v < vertex_count; ++v) state.growth.add_vertex();
  for (Index t = 0; t < triangle_count; ++t) {
    Triangle triangle{};
    if (!meshes.code(triangle) || is_degenerate(triangle))
      return bad(offset, "the coarsest mesh has a triangle with wrong corners");
    state.growth.add_coarsest(triangle);
  }
  FourKCoding<RangeDecoder> coding(coder, state.models, state.growth, state.lattice, state.numbers,
                                   header_.vertex_count);
  for (Index v = 0; v < vertex_count; ++v) {
    Lattice position{};
    Index number = 0;
    if (!coding.coarsest(position, number)) return bad(offset, "the coarsest mesh has a wrong vertex");
  }
  return {};
}

Result<void> FourKDecoder::read_clusters(std::uint64_t offset, PartState& state) const {
  const auto payload = payload_at(offset);
  if (!payload) return payload.error();
  FieldReader fields(*payload);
  const Index cluster_count = fields.u32();
  if (fields.overrun()) return bad(offset, "a chunk of clusters is too short");
  const std::uint64_t most = state.growth.operation_count() + kMostOperationsPerByte * fields.left();
  const std::uint64_t end = std::min<std::uint64_t>(most, state.operation_count);
  RangeDecoder coder(payload->last(fields.left()));
  FourKCoding<RangeDecoder> coding(coder, state.models, state.growth, state.lattice, state.numbers,
                                   header_.vertex_count);
  for (Index i = 0; i < cluster_count; ++i) {
    FourKRemoval removal;
    if (state.growth.operation_count() >= end || !coding.removal(removal))
      return bad(offset, "a cluster does not fit the mesh");
    state.errors.push_back(removal.error);
    if (removal.swap_count > end - state.growth.operation_count())
      return bad(offset, "a cluster has more swaps than its chunk can hold");
    for (std::uint32_t s = 0; s < removal.swap_count; ++s) {
      FourKSwap swap;
      if (!coding.swap(removal.error, swap)) return bad(offset, "a swap does not fit the mesh");
      state.errors.push_back(swap.error);
    }
  }
  return {};
}

Result<FourKPart> FourKDecoder::read_part(std::uint32_t part, FourKPoseBase* base) const {
  assert(part < part_count());
  const Part& where = parts_[part];
  PartState state;
  if (Result<void> read = read_coarsest(where.offset, state); !read) return read.error();
  for (const std::uint64_t offset : where.chunks)
    if (Result<void> read = read_clusters(offset, state); !read) return read.error();
  FourKPart out;
  out.mesh = state.growth.assemble();
  out.is_whole = state.growth.operation_count() == state.operation_count;
  if (!out.is_whole && (part + 1 < part_count() || !poses_.empty() || is_whole_))
    return bad(where.offset, "a part has fewer operations than it announces");
  const Index missing = state.operation_count - out.mesh.operation_count();
  out.mesh.level_begin.push_back(0);
  for (const Index end : state.level_ends)
    if (end > missing) out.mesh.level_begin.push_back(end - missing);
  const Quantizer lattice = quantizer();
  for (const Lattice& at : state.lattice) {
    out.positions.push_back(lattice.position(at));
    if (!is_finite(out.positions.back())) return bad(where.offset, "a position is not a finite number");
  }
  for (std::size_t i = state.errors.size(); i-- > 0;) out.mesh.error.push_back(error_value(state.errors[i]));
  make_monotone(out.mesh, out.positions, 1);
  out.numbers = std::move(state.numbers);
  if (!base) return out;
  base->parents.assign(state.growth.vertex_count(), {kNone, kNone, kNone, kNone});
  for (Index v = 0; v < state.growth.vertex_count(); ++v)
    std::ranges::copy(state.growth.parents(v), base->parents[v].begin());
  base->positions = std::move(state.lattice);
  base->errors = std::move(state.errors);
  return out;
}

Result<std::uint32_t> FourKDecoder::builds_on(std::uint32_t frame) const {
  assert(frame > 0 && frame < frame_count());
  const std::uint64_t offset = poses_[frame - 1];
  const auto payload = payload_at(offset);
  if (!payload) return payload.error();
  FieldReader fields(*payload);
  const std::uint32_t from = fields.u32();
  if (fields.overrun() || from >= frame) return bad(offset, "a frame builds on one that is not before it");
  return from;
}

Result<void> FourKDecoder::read_pose(std::uint32_t frame, const FourKPoseBase& base, std::span<const Lattice> from,
                                     std::span<Lattice> now, std::span<std::int32_t> errors) const {
  assert(frame > 0 && frame < frame_count() && from.size() == now.size() && from.data() != now.data());
  const std::uint64_t offset = poses_[frame - 1];
  const auto payload = payload_at(offset);
  if (!payload) return payload.error();
  if (payload->size() < 4) return bad(offset, "a frame is too short");
  RangeDecoder coder(payload->subspan(4));
  LatticeModels models;
  const auto parents = [&](Index v) {
    const auto& all = base.parents[v];
    return std::span(all.data(), static_cast<std::size_t>(std::find(all.begin(), all.end(), kNone) - all.begin()));
  };
  code_pose(coder, models, parents, from, now, [](Index) { return Lattice{}; });
  if (!code_pose_errors(coder, errors, [](std::size_t) { return 0; }))
    return bad(offset, "a frame has an error outside its range");
  return {};
}

}  // namespace limber
