// SPDX-License-Identifier: Apache-2.0
#include "limber/stream/encoder.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

#include "limber/stream/chunk.h"
#include "limber/stream/coding_state.h"
#include "limber/stream/header.h"
#include "limber/stream/lattice.h"
#include "limber/stream/mesh_coding.h"
#include "limber/stream/motion_factors.h"

namespace limber {
namespace {

StreamHeader make_header(const Hierarchy& base, std::span<const Vec3f> first_positions, const EncoderOptions& options) {
  Box box;
  for (const Vec3f& position : first_positions) box.add(Vec3d(position));
  StreamHeader header;
  header.frame_count = options.frame_count;
  header.first_frame_number = options.first_frame_number;
  header.frames_per_second = options.frames_per_second;
  header.diagonal = box.diagonal();
  header.key_interval = options.key_interval;
  header.manifold_kept = options.manifold_kept;
  header.level_begin = base.level_begin;
  if (!options.lossless) {
    header.tolerance = options.tolerance * header.diagonal;
    const LatticeChoice lattice = choose_lattice(header.tolerance, box);
    header.origin = lattice.origin;
    header.step = lattice.step;
    if (header.step == 0.0) header.tolerance = 0.0;
  }
  return header;
}

std::vector<std::byte> header_payload(const StreamHeader& header, std::size_t triangle_count) {
  std::vector<std::byte> payload;
  append_little_endian(payload, (header.manifold_kept ? 1u : 0u) | (header.frame_count ? 2u : 0u));
  append_little_endian(payload, header.frame_count.value_or(0));
  append_little_endian(payload, header.first_frame_number);
  append_little_endian(payload, header.key_interval);
  append_double(payload, header.frames_per_second);
  append_double(payload, header.origin.x);
  append_double(payload, header.origin.y);
  append_double(payload, header.origin.z);
  append_double(payload, header.step);
  append_double(payload, header.tolerance);
  append_double(payload, header.diagonal);
  append_little_endian(payload, static_cast<std::uint32_t>(triangle_count));
  append_little_endian(payload, static_cast<std::uint32_t>(header.level_begin.size() - 1));
  for (std::size_t level = 1; level < header.level_begin.size(); ++level)
    append_little_endian(payload, header.level_begin[level]);
  return payload;
}

// Padded, so that a reader may allocate in proportion to the bytes present.
std::vector<std::byte> mesh_payload(const Mesh& mesh, Index node_count) {
  RangeEncoder coder;
  MeshCoding<RangeEncoder> coding(coder, mesh.vertex_count, mesh.triangles.size());
  for (Triangle triangle : mesh.triangles) coding.code(triangle);
  std::vector<std::byte> payload = coder.finish();
  const std::uint64_t least = (node_count + mesh.triangles.size() + kMostPerMeshByte - 1) / kMostPerMeshByte;
  if (payload.size() < least) payload.resize(static_cast<std::size_t>(least));
  return payload;
}

std::vector<std::byte> step_factors(std::initializer_list<std::int16_t> factors) {
  std::vector<std::byte> bytes;
  for (const std::int16_t factor : factors) append_little_endian(bytes, static_cast<std::uint16_t>(factor));
  return bytes;
}

void append(std::vector<std::byte>& to, const std::vector<std::byte>& bytes) {
  to.insert(to.end(), bytes.begin(), bytes.end());
}

}  // namespace

struct Encoder::Stream {
  ByteSink sink;
  std::uint64_t written = 0;
  StreamHeader header;
  Quantizer quantizer;
  Mesh mesh;
  std::unique_ptr<CodingState> coding;
  std::vector<Lattice> lattice;        // [node_count], of the frame being written
  std::vector<std::uint64_t> offsets;  // of the frames' chunks
  std::vector<std::uint32_t> keys;     // the key frames
  ChunkSizes sizes;                    // of the frame written last

  Result<void> write(std::span<const std::byte> bytes);
  Result<void> write_chunk(std::uint32_t kind, std::uint32_t number, std::span<const std::byte> payload);
  Result<void> quantize(std::span<const Vec3f> positions);
  std::vector<std::byte> hierarchy_section(bool key, const Hierarchy& hierarchy, std::span<const Swap> swaps);
  std::vector<std::byte> finest_section(bool key);
  Lattice settle(const Vec3f& best, const Leeway& leeway, const Lattice64& predicted) const;
  std::vector<std::byte> coarser_section(bool key, std::span<const Vec3f> positions, std::span<const Leeway> leeways);
  std::vector<std::byte> error_section(bool key, std::span<const float> errors);
};

Result<void> Encoder::Stream::write(std::span<const std::byte> bytes) {
  written += bytes.size();
  return sink(bytes);
}

Result<void> Encoder::Stream::write_chunk(std::uint32_t kind, std::uint32_t number,
                                          std::span<const std::byte> payload) {
  if (payload.size() > std::numeric_limits<std::uint32_t>::max())
    return Error{ErrorCode::kUnsupported, place_in_stream(written), "a chunk of 4 GiB or more; split the mesh"};
  auto result = write(chunk_header(kind, number, payload));
  return result ? write(payload) : result;
}

Result<void> Encoder::Stream::quantize(std::span<const Vec3f> positions) {
  const auto frame = static_cast<std::uint32_t>(offsets.size());
  const double most = header.tolerance * header.tolerance;
  for (std::size_t node = 0; node < positions.size(); ++node) {
    const auto refuse = [&](ErrorCode code, const char* what) {
      return Error{code, "frame " + std::to_string(frame) + ", node " + std::to_string(node), what};
    };
    if (!is_finite(positions[node])) return refuse(ErrorCode::kBadInput, "a position that is not finite");
    constexpr auto kTooFar = "a position too far from the first frame to keep the tolerance; write the clip losslessly";
    if (!quantizer.fits(positions[node])) return refuse(ErrorCode::kUnsupported, kTooFar);
    lattice[node] = quantizer.lattice(positions[node]);
    if (!quantizer.lossless() &&
        squared_length(Vec3d(quantizer.position(lattice[node])) - Vec3d(positions[node])) > most)
      return refuse(ErrorCode::kUnsupported, kTooFar);
  }
  return {};
}

std::vector<std::byte> Encoder::Stream::hierarchy_section(bool key, const Hierarchy& hierarchy,
                                                          std::span<const Swap> swaps) {
  RangeEncoder coder;
  if (key) {
    coding->reset_models();
    code_key_hierarchy(coder, coding->hierarchy_models, coding->clusters, coding->traversal, coding->order,
                       hierarchy.parent);
  } else {
    std::vector<Swap> sorted(swaps.begin(), swaps.end());
    std::sort(sorted.begin(), sorted.end(), [&hierarchy](const Swap& a, const Swap& b) {
      const Index a_level = hierarchy.level_of(a.node), b_level = hierarchy.level_of(b.node);
      return a_level != b_level ? a_level > b_level : a.node < b.node;
    });
    coding->clusters.forget_changes();
    code_swaps(coder, coding->hierarchy_models, coding->clusters, sorted);
  }
  assert(std::equal(hierarchy.parent.begin(), hierarchy.parent.end(), coding->clusters.parents().begin()));
  return coder.finish();
}

std::vector<std::byte> Encoder::Stream::finest_section(bool key) {
  const Traversal& traversal = coding->traversal;
  std::vector<Lattice> by_place(traversal.order.size());
  for (Index i = 0; i < by_place.size(); ++i) by_place[i] = lattice[traversal.order[i]];
  const auto actual = [&by_place](Index place) { return by_place[place]; };
  ResidualWriter writer(coding->finest_statistics);
  std::vector<std::byte> section;
  if (key) {
    coding->finest.code_key(writer, actual);
  } else {
    const MotionFactors factors = best_motion_factors(traversal, coding->finest, by_place);
    section = step_factors({factors.past, factors.here, factors.before});
    coding->finest.code_step(factors, writer, actual);
  }
  append(section, writer.finish());
  coding->finest_statistics.update();
  return section;
}

// The lattice point nearest to where the leeway lets the node be drawn by its prediction.
Lattice Encoder::Stream::settle(const Vec3f& best, const Leeway& leeway, const Lattice64& predicted) const {
  constexpr std::int64_t kMost = 1 << 30;
  Lattice wanted;
  for (std::size_t k = 0; k < 3; ++k) {
    if (predicted[k] < -kMost || predicted[k] > kMost) return quantizer.lattice(best);
    wanted[k] = static_cast<std::int32_t>(predicted[k]);
  }
  const Vec3d towards = Vec3d(quantizer.position(wanted)) - Vec3d(best);
  const Vec3f settled(Vec3d(best) + displacement_towards(towards, leeway));
  return quantizer.lattice(quantizer.fits(settled) ? settled : best);
}

std::vector<std::byte> Encoder::Stream::coarser_section(bool key, std::span<const Vec3f> positions,
                                                        std::span<const Leeway> leeways) {
  if (coding->coarser.positions().empty()) return {};
  const bool settling = !leeways.empty() && !quantizer.lossless();
  const Index vertex_count = header.level_begin[1];
  ResidualWriter writer(coding->coarser_statistics);
  coding->coarser.code(key, coding->clusters.parents(), coding->traversal, coding->finest, writer,
                       [&](Index node, const Lattice64& predicted) {
                         if (!settling) return lattice[node];
                         return settle(positions[node], leeways[node - vertex_count], predicted);
                       });
  std::vector<std::byte> section = writer.finish();
  coding->coarser_statistics.update();
  return section;
}

std::vector<std::byte> Encoder::Stream::error_section(bool key, std::span<const float> errors) {
  ErrorState& state = coding->errors;
  if (state.nodes.empty()) return {};
  const Index vertex_count = header.level_begin[1];
  ResidualStatistics& statistics = key ? state.key_statistics : state.step_statistics;
  ResidualWriter writer(statistics);
  code_errors(writer, state, key, coding->clusters.changed(),
              [&](std::size_t i) { return quantized_error(errors[vertex_count + i]); });
  std::vector<std::byte> section = writer.finish();
  statistics.update();
  return section;
}

Encoder::Encoder(ByteSink sink) : stream_(std::make_unique<Stream>()) { stream_->sink = std::move(sink); }
Encoder::~Encoder() = default;
Encoder::Encoder(Encoder&&) noexcept = default;
Encoder& Encoder::operator=(Encoder&&) noexcept = default;

Result<void> Encoder::begin(const Mesh& mesh, const Hierarchy& base, std::span<const Vec3f> first_positions,
                            const EncoderOptions& options) {
  assert(!stream_->coding && base.vertex_count() == mesh.vertex_count && first_positions.size() == mesh.vertex_count);
  assert(options.key_interval >= 1 && options.frames_per_second > 0.0 && (options.lossless || options.tolerance > 0.0));
  if (base.node_count() > kMostNodes || mesh.triangles.size() > kMostTriangles || base.level_count() > kMostLevels)
    return Error{ErrorCode::kUnsupported, "", "the mesh or its hierarchy is larger than a stream can hold"};
  Stream& stream = *stream_;
  stream.header = make_header(base, first_positions, options);
  stream.quantizer = Quantizer(stream.header);
  stream.coding = std::make_unique<CodingState>(mesh, stream.header.level_begin, stream.header.step == 0.0);
  stream.lattice.resize(base.node_count());

  std::vector<std::byte> preamble;
  for (const std::uint8_t byte : kMagic) preamble.push_back(static_cast<std::byte>(byte));
  append_little_endian(preamble, kStreamVersion);
  auto result = stream.write(preamble);
  if (result) result = stream.write_chunk(kHeaderChunk, 0, header_payload(stream.header, mesh.triangles.size()));
  if (result) result = stream.write_chunk(kMeshChunk, 0, mesh_payload(mesh, base.node_count()));
  return result;
}

Result<void> Encoder::add(const Hierarchy& hierarchy, std::span<const Swap> net_swaps, std::span<const Vec3f> positions,
                          std::span<const float> errors, std::span<const Leeway> leeways, bool force_key) {
  Stream& stream = *stream_;
  assert(stream.coding && hierarchy.level_begin == stream.header.level_begin);
  assert(positions.size() == hierarchy.node_count() && errors.size() == hierarchy.node_count());
  assert(leeways.empty() || leeways.size() == hierarchy.node_count() - hierarchy.vertex_count());
  auto result = stream.quantize(positions);
  if (!result) return result;

  const auto frame = static_cast<std::uint32_t>(stream.offsets.size());
  const bool key = force_key || frame == 0 || frame - stream.keys.back() >= stream.header.key_interval;
  const std::array<std::vector<std::byte>, kSectionCount> sections{
      stream.hierarchy_section(key, hierarchy, net_swaps), stream.finest_section(key),
      stream.coarser_section(key, positions, leeways), stream.error_section(key, errors)};
  std::vector<std::byte> payload;
  for (const auto& section : sections) append_little_endian(payload, static_cast<std::uint32_t>(section.size()));
  for (const auto& section : sections) append(payload, section);
  stream.sizes = {.hierarchy = sections[0].size(),
                  .finest_positions = sections[1].size(),
                  .coarser_positions = sections[2].size(),
                  .errors = sections[3].size(),
                  .overhead = kChunkHeaderSize + kSectionTableSize};
  stream.offsets.push_back(stream.written);
  if (key) stream.keys.push_back(frame);
  return stream.write_chunk(key ? kKeyChunk : kStepChunk, frame, payload);
}

const ChunkSizes& Encoder::sizes() const { return stream_->sizes; }

Result<void> Encoder::finish() {
  Stream& stream = *stream_;
  assert(stream.coding);
  const auto frame_count = static_cast<std::uint32_t>(stream.offsets.size());
  if (stream.header.frame_count && *stream.header.frame_count != frame_count)
    return Error{ErrorCode::kMismatch, "",
                 std::to_string(*stream.header.frame_count) + " frames were announced, but " +
                     std::to_string(frame_count) + " came"};
  const std::uint64_t index_at = stream.written;
  std::vector<std::byte> payload;
  append_little_endian(payload, frame_count);
  append_little_endian(payload, static_cast<std::uint32_t>(stream.keys.size()));
  for (const std::uint64_t offset : stream.offsets) append_little_endian(payload, offset);
  for (const std::uint32_t key : stream.keys) append_little_endian(payload, key);
  auto result = stream.write_chunk(kIndexChunk, 0, payload);
  if (!result) return result;
  std::vector<std::byte> end_mark;
  append_little_endian(end_mark, index_at);
  for (const std::uint8_t byte : kEndMagic) end_mark.push_back(static_cast<std::byte>(byte));
  return stream.write(end_mark);
}

}  // namespace limber
