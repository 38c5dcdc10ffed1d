// SPDX-License-Identifier: Apache-2.0
#include "limber/stream/decoder.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>

#include "limber/stream/chunk.h"
#include "limber/stream/coding_state.h"
#include "limber/stream/frame_decoding.h"
#include "limber/stream/mesh_coding.h"

namespace limber {
namespace {

struct Section {
  std::size_t begin, length;  // in the stream
};

struct FrameEntry {
  std::uint64_t offset;  // of the frame's chunk
  std::uint32_t key;     // the key frame at or before

  friend bool operator==(const FrameEntry&, const FrameEntry&) = default;
};

Error bad(std::uint64_t offset, std::string what) {
  return {ErrorCode::kBadInput, place_in_stream(offset), std::move(what)};
}

Error truncated(std::uint64_t offset, std::string what) {
  return {ErrorCode::kTruncated, place_in_stream(offset), std::move(what)};
}

// How much of `bytes` from `offset` on is there must agree with `expected`.
bool agrees(std::span<const std::byte> bytes, std::uint64_t offset, std::span<const std::uint8_t> expected) {
  const std::size_t present = std::min<std::size_t>(bytes.size() - static_cast<std::size_t>(offset), expected.size());
  return present == 0 || std::memcmp(bytes.data() + offset, expected.data(), present) == 0;
}

// Gives the offset of the first chunk.
Result<std::uint64_t> read_preamble(std::span<const std::byte> bytes) {
  if (!agrees(bytes, 0, kMagic)) return bad(0, "not a .limber stream: its first bytes are others");
  if (bytes.size() < kPreambleSize) return truncated(bytes.size(), "the stream ends before its header");
  const auto version = load_little_endian<std::uint32_t>(&bytes[kMagic.size()]);
  if (version != kStreamVersion)
    return Error{ErrorCode::kUnsupported, place_in_stream(kMagic.size()),
                 "version " + std::to_string(version) + " of the format; this limber reads version " +
                     std::to_string(kStreamVersion)};
  return std::uint64_t{kPreambleSize};
}

// The payload of the next chunk that is not optional, which must be of the given kind; `offset` goes past it.
Result<std::span<const std::byte>> next_payload(std::span<const std::byte> bytes, std::uint32_t kind,
                                                std::uint64_t& offset) {
  while (true) {
    const auto header = read_chunk_header(bytes, offset);
    if (!header) return header.error();
    if (!is_optional(header->kind) && header->kind != kind) return bad(offset, "header and mesh do not come first");
    if (!chunk_is_whole(bytes, offset, *header))
      return truncated(bytes.size(), "the stream ends before its first frame");
    const std::uint64_t at = offset;
    offset += kChunkHeaderSize + header->length;
    if (header->kind == kind) return read_payload(bytes, at, *header);
  }
}

Result<Mesh> read_mesh(std::span<const std::byte> payload, std::uint64_t offset, Index vertex_count, Index node_count,
                       std::uint32_t triangle_count) {
  if (std::uint64_t{node_count} + triangle_count > kMostPerMeshByte * payload.size())
    return bad(offset, "the mesh chunk is too short for the numbers of nodes and triangles announced");
  Mesh mesh;
  mesh.vertex_count = vertex_count;
  mesh.triangles.resize(triangle_count);
  RangeDecoder coder(payload);
  MeshCoding<RangeDecoder> coding(coder, vertex_count, triangle_count);
  for (Triangle& triangle : mesh.triangles)
    if (!coding.code(triangle)) return bad(offset, "the mesh names a vertex beyond the last");
  return mesh;
}

}  // namespace

struct Decoder::Stream {
  std::span<const std::byte> bytes;
  StreamHeader header;
  Mesh mesh;
  std::vector<FrameEntry> frames;
  std::uint64_t scanned = 0;              // all chunks before this offset are known
  std::optional<std::uint64_t> index_at;  // where the index chunk begins, once it has arrived
  Quantizer quantizer;
  std::unique_ptr<CodingState> coding;
  std::uint32_t hierarchy_frame = kNone;          // the frame that decode_hierarchy() and
  std::uint32_t position_frame = kNone;           // decode_positions() finished last
  std::array<Section, kSectionCount> sections{};  // of hierarchy_frame

  Result<void> scan();
  Result<bool> scan_chunk();
  Result<void> check_end() const;
  Result<bool> use_index();
  Result<std::vector<FrameEntry>> read_index(std::uint64_t offset) const;
  void add_frame(std::uint64_t offset, bool key);

  Error bad_frame(std::uint32_t frame, const char* what) const {
    return {ErrorCode::kBadInput, place_in_stream(frames[frame].offset, frame), what};
  }
  Result<void> read_sections(std::uint32_t frame);
  std::span<const std::byte> section(std::size_t i) const {
    return bytes.subspan(sections[i].begin, sections[i].length);
  }
};

void Decoder::Stream::add_frame(std::uint64_t offset, bool key) {
  const auto frame = static_cast<std::uint32_t>(frames.size());
  frames.push_back({offset, key ? frame : frames.back().key});
}

// Goes on over the chunks that have arrived since the last time.
Result<void> Decoder::Stream::scan() {
  while (!index_at) {
    const auto more = scan_chunk();
    if (!more) return more.error();
    if (!*more) return {};
  }
  return check_end();
}

// Gives false where the next chunk is not whole yet.
Result<bool> Decoder::Stream::scan_chunk() {
  if (bytes.size() - scanned < kChunkHeaderSize) return false;
  const auto chunk = read_chunk_header(bytes, scanned);
  if (!chunk) return chunk.error();
  const bool key = chunk->kind == kKeyChunk;
  if (key || chunk->kind == kStepChunk) {
    if (chunk->number != frames.size()) return bad(scanned, "the frames are not in order");
    if (frames.empty() && !key) return bad(scanned, "the first frame is not a key frame");
    if (header.frame_count && frames.size() == *header.frame_count)
      return bad(scanned, "there are more frames than the header announces");
  } else if (chunk->kind != kIndexChunk && !is_optional(chunk->kind)) {
    return Error{ErrorCode::kUnsupported, place_in_stream(scanned),
                 "a chunk of a kind that this limber does not know; it needs a newer one"};
  }
  if (!chunk_is_whole(bytes, scanned, *chunk)) return false;
  if (chunk->kind == kIndexChunk) {
    const auto entries = read_index(scanned);
    if (!entries) return entries.error();
    if (!std::equal(entries->begin(), entries->end(), frames.begin(), frames.end()))
      return bad(scanned, "the index names other frames than there are");
    index_at = scanned;
  } else if (key || chunk->kind == kStepChunk) {
    add_frame(scanned, key);
  }
  scanned += kChunkHeaderSize + chunk->length;
  return true;
}

// After the index comes its own offset, a mark, and nothing else.
Result<void> Decoder::Stream::check_end() const {
  std::array<std::uint8_t, kEndMarkSize> expected;
  for (std::size_t i = 0; i < 8; ++i) expected[i] = static_cast<std::uint8_t>(*index_at >> (8 * i));
  std::copy(kEndMagic.begin(), kEndMagic.end(), expected.begin() + 8);
  if (!agrees(bytes, scanned, expected) || bytes.size() - scanned > kEndMarkSize)
    return bad(scanned, "the end of the stream is damaged");
  return {};
}

// Where the stream is whole the frames are known from the index; false where it is not, or seems not to be.
Result<bool> Decoder::Stream::use_index() {
  if (bytes.size() - scanned < kEndMarkSize) return false;
  const auto end_mark = bytes.last(kEndMarkSize);
  if (std::memcmp(&end_mark[8], kEndMagic.data(), kEndMagic.size()) != 0) return false;
  const auto offset = load_little_endian<std::uint64_t>(end_mark.data());
  if (offset < scanned || offset > bytes.size() - kEndMarkSize) return false;
  const auto chunk = read_chunk_header(bytes, offset);
  if (!chunk || chunk->kind != kIndexChunk || !chunk_is_whole(bytes, offset, *chunk)) return false;
  if (offset + kChunkHeaderSize + chunk->length + kEndMarkSize != bytes.size()) return false;
  auto entries = read_index(offset);
  if (!entries) return entries.error();
  if (entries->size() < frames.size() || !std::equal(frames.begin(), frames.end(), entries->begin()))
    return bad(offset, "the index names other frames than there are");
  frames = std::move(*entries);
  index_at = offset;
  scanned = offset + kChunkHeaderSize + chunk->length;
  return true;
}

Result<std::vector<FrameEntry>> Decoder::Stream::read_index(std::uint64_t offset) const {
  const auto chunk = read_chunk_header(bytes, offset);
  if (!chunk) return chunk.error();
  const auto payload = read_payload(bytes, offset, *chunk);
  if (!payload) return payload.error();
  FieldReader fields(*payload);
  const std::uint32_t frame_count = fields.u32(), key_count = fields.u32();
  if (fields.overrun() || fields.left() != 8 * std::uint64_t{frame_count} + 4 * std::uint64_t{key_count})
    return bad(offset, "the index does not have the length that it announces");
  if (header.frame_count && frame_count != *header.frame_count)
    return bad(offset, "the index has another number of frames than the header");
  std::vector<FrameEntry> entries(frame_count);
  std::uint64_t end = kPreambleSize;
  for (FrameEntry& entry : entries) {
    entry.offset = fields.u64();
    if (entry.offset < end || entry.offset > offset || offset - entry.offset < kChunkHeaderSize + kSectionTableSize)
      return bad(offset, "the index has offsets that are not in order");
    end = entry.offset + kChunkHeaderSize + kSectionTableSize;
  }
  std::uint32_t key = 0;
  for (std::uint32_t i = 0; i < key_count; ++i) {
    const std::uint32_t next = fields.u32();
    if (next >= frame_count || (i == 0 ? next != 0 : next <= key)) return bad(offset, "the index has wrong key frames");
    for (std::uint32_t frame = key; frame < next; ++frame) entries[frame].key = key;
    key = next;
  }
  if (key_count == 0 && frame_count > 0) return bad(offset, "the index has no key frame");
  for (std::uint32_t frame = key; frame < frame_count; ++frame) entries[frame].key = key;
  return entries;
}

Result<void> Decoder::Stream::read_sections(std::uint32_t frame) {
  const std::uint64_t offset = frames[frame].offset;
  const auto chunk = read_chunk_header(bytes, offset);
  if (!chunk) return Error{chunk.error().code, place_in_stream(offset, frame), chunk.error().what};
  if (chunk->kind != (frames[frame].key == frame ? kKeyChunk : kStepChunk) || chunk->number != frame ||
      !chunk_is_whole(bytes, offset, *chunk))
    return bad_frame(frame, "the index points to another chunk");
  const auto payload = read_payload(bytes, offset, *chunk);
  if (!payload) return Error{payload.error().code, place_in_stream(offset, frame), payload.error().what};
  FieldReader table(*payload);
  std::size_t begin = static_cast<std::size_t>(offset) + kChunkHeaderSize + kSectionTableSize;
  std::uint64_t left = std::uint64_t{chunk->length};
  left = left < kSectionTableSize ? 0 : left - kSectionTableSize;
  for (Section& part : sections) {
    part = {begin, table.u32()};
    if (table.overrun() || part.length > left) return bad_frame(frame, "a section reaches beyond its chunk");
    begin += part.length;
    left -= part.length;
  }
  if (left != 0) return bad_frame(frame, "the sections do not fill their chunk");
  return {};
}

Decoder::Decoder() = default;
Decoder::~Decoder() = default;
Decoder::Decoder(Decoder&&) noexcept = default;
Decoder& Decoder::operator=(Decoder&&) noexcept = default;

Result<void> Decoder::open(std::span<const std::byte> bytes) {
  stream_.reset();
  auto stream = std::make_unique<Stream>();
  stream->bytes = bytes;
  const auto first_chunk = read_preamble(bytes);
  if (!first_chunk) return first_chunk.error();
  std::uint64_t& offset = stream->scanned;
  offset = *first_chunk;

  const auto header_payload = next_payload(bytes, kHeaderChunk, offset);
  if (!header_payload) return header_payload.error();
  std::uint32_t triangle_count = 0;
  auto header = read_stream_header(*header_payload, kPreambleSize, triangle_count);
  if (!header) return header.error();
  stream->header = std::move(*header);

  const std::uint64_t mesh_at = offset;
  const auto mesh_payload = next_payload(bytes, kMeshChunk, offset);
  if (!mesh_payload) return mesh_payload.error();
  const auto& level_begin = stream->header.level_begin;
  auto mesh = read_mesh(*mesh_payload, mesh_at, level_begin[1], level_begin.back(), triangle_count);
  if (!mesh) return mesh.error();
  stream->mesh = std::move(*mesh);

  const auto indexed = stream->use_index();
  if (!indexed) return indexed.error();
  if (!*indexed) {
    const auto scanned = stream->scan();
    if (!scanned) return scanned.error();
  }
  stream->quantizer = Quantizer(stream->header);
  stream->coding = std::make_unique<CodingState>(stream->mesh, level_begin, stream->header.step == 0.0);
  stream_ = std::move(stream);
  return {};
}

Result<void> Decoder::extend(std::span<const std::byte> bytes) {
  assert(stream_ && bytes.size() >= stream_->bytes.size());
  Stream& stream = *stream_;
  const auto old_bytes = stream.bytes;
  const std::size_t old_frames = stream.frames.size();
  const std::uint64_t old_scanned = stream.scanned;
  const auto old_index = stream.index_at;
  stream.bytes = bytes;
  auto scanned = stream.scan();
  if (!scanned) {
    stream.bytes = old_bytes;
    stream.frames.resize(old_frames);
    stream.scanned = old_scanned;
    stream.index_at = old_index;
  }
  return scanned;
}

Result<bool> Decoder::use_index(std::span<const std::byte> bytes) {
  assert(stream_ && bytes.size() >= stream_->bytes.size());
  Stream& stream = *stream_;
  const auto old_bytes = stream.bytes;
  stream.bytes = bytes;
  if (stream.index_at) return true;
  auto used = stream.use_index();
  if (!used || !*used) stream.bytes = old_bytes;
  return used;
}

const StreamHeader& Decoder::header() const { return assert(stream_), stream_->header; }

const Mesh& Decoder::mesh() const { return assert(stream_), stream_->mesh; }

std::uint32_t Decoder::available_frames() const {
  assert(stream_);
  return static_cast<std::uint32_t>(stream_->frames.size());
}

std::optional<std::uint32_t> Decoder::frame_count() const {
  assert(stream_);
  if (stream_->index_at) return available_frames();
  return stream_->header.frame_count;
}

bool Decoder::is_key(std::uint32_t frame) const { return key_at_or_before(frame) == frame; }

std::uint32_t Decoder::key_at_or_before(std::uint32_t frame) const {
  assert(frame < available_frames());
  return stream_->frames[frame].key;
}

ChunkSizes Decoder::sizes(std::uint32_t frame) const {
  assert(frame < available_frames());
  ChunkSizes sizes;
  const std::uint64_t offset = stream_->frames[frame].offset;
  const auto table = stream_->bytes.subspan(static_cast<std::size_t>(offset) + kChunkHeaderSize, kSectionTableSize);
  FieldReader fields(table);
  sizes.hierarchy = fields.u32();
  sizes.finest_positions = fields.u32();
  sizes.coarser_positions = fields.u32();
  sizes.errors = fields.u32();
  sizes.overhead = kChunkHeaderSize + kSectionTableSize;
  return sizes;
}

Extent Decoder::extent(std::uint32_t frame) const {
  assert(frame < available_frames());
  const Stream& stream = *stream_;
  if (frame + 1 < stream.frames.size()) return {stream.frames[frame].offset, stream.frames[frame + 1].offset};
  return {stream.frames[frame].offset, stream.index_at.value_or(stream.scanned)};
}

void Decoder::prepare(FrameState& state) const {
  assert(stream_);
  const auto& level_begin = stream_->header.level_begin;
  state.frame = kNone;
  state.hierarchy.level_begin = level_begin;
  state.hierarchy.parent.assign(level_begin.back(), kNone);
  state.positions.assign(level_begin.back(), {});
  state.errors.assign(level_begin.back(), 0.0f);
  state.swaps.clear();
  state.swaps.reserve(level_begin.back());
}

Result<void> Decoder::decode_hierarchy(std::uint32_t frame, FrameState& state) {
  assert(frame < available_frames());
  assert(state.hierarchy.level_begin == header().level_begin);
  const bool key = is_key(frame);
  assert(key || (state.frame == frame - 1 && stream_->position_frame == frame - 1));
  stream_->hierarchy_frame = stream_->position_frame = state.frame = kNone;
  auto sections = stream_->read_sections(frame);
  if (!sections) return sections;
  if (!decode_hierarchy_section(*stream_->coding, key, stream_->section(0), state))
    return stream_->bad_frame(frame, "the hierarchy names a node that cannot be meant");
  stream_->hierarchy_frame = state.frame = frame;
  return {};
}

Result<void> Decoder::decode_positions(std::uint32_t frame, FrameState& state) {
  assert(stream_ && stream_->hierarchy_frame == frame && state.frame == frame);
  const Stream& stream = *stream_;
  const char* broken = decode_position_sections(*stream.coding, stream.quantizer, is_key(frame),
                                                {stream.section(1), stream.section(2), stream.section(3)}, state);
  if (broken != nullptr) {
    stream_->hierarchy_frame = state.frame = kNone;
    return stream_->bad_frame(frame, broken);
  }
  stream_->position_frame = frame;
  return {};
}

Result<void> Decoder::decode(std::uint32_t frame, FrameState& state) {
  auto hierarchy = decode_hierarchy(frame, state);
  if (!hierarchy) return hierarchy;
  return decode_positions(frame, state);
}

}  // namespace limber
