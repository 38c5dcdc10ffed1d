// SPDX-License-Identifier: Apache-2.0
#include "limber/stream/four_k_encoder.h"

#include <algorithm>
#include <cassert>
#include <iterator>
#include <limits>
#include <utility>
#include <vector>

#include "limber/stream/chunk.h"
#include "limber/stream/four_k_coding.h"
#include "limber/stream/lattice.h"
#include "limber/stream/mesh_coding.h"

namespace limber {
namespace {

constexpr Index kClustersPerChunk = 2048;

Error not_clusters() {
  return {ErrorCode::kUnsupported, "", "the swaps of a 4-K mesh must stand right before the removal of their vertex"};
}

// The first operation of each cluster.
std::vector<Index> cluster_begins(const FourKMesh& mesh) {
  std::vector<Index> begins;
  for (Index o = 0; o < mesh.operation_count(); ++o)
    if (o == 0 || mesh.is_removal(o - 1)) begins.push_back(o);
  return begins;
}

// One part: its growth, and where the mesh's vertices and triangles are in it.
class PartWriter {
 public:
  PartWriter(const FourKMesh& mesh, std::span<const Vec3f> positions, std::span<const Index> numbers,
             const Quantizer& quantizer)
      : mesh_(mesh),
        positions_(positions),
        input_numbers_(numbers),
        quantizer_(quantizer),
        file_of_(mesh.vertex_count, kNone),
        grown_(mesh.triangle_count(), kNone) {}

  std::vector<std::byte> coarsest(Index input_count);
  // Clusters from `first` to `end`, last first; false where they are none.
  bool clusters(std::span<const Index> begins, Index end, Index input_count, std::vector<std::byte>& payload);

  // By number in the file.
  std::vector<Lattice> lattice;
  std::vector<Index> vertices;  // of the mesh
  FourKGrowth growth;

 private:
  using Coding = FourKCoding<RangeEncoder>;

  Index number(Index v) const { return input_numbers_.empty() ? v : input_numbers_[v]; }
  Index place_of(Index u, Index triangle) const {
    const auto star = growth.star(file_of_[u]);
    return static_cast<Index>(std::find(star.begin(), star.end(), grown_[triangle]) - star.begin());
  }
  bool take_brought(Index operation);
  bool cluster(Coding& coding, Index first, Index removal);
  Refinement removal_kind(Index removal) const;

  const FourKMesh& mesh_;
  std::span<const Vec3f> positions_;
  std::span<const Index> input_numbers_;
  const Quantizer& quantizer_;
  std::vector<Index> file_of_;  // [mesh.vertex_count]
  std::vector<Index> grown_;    // [mesh.triangle_count]: in growth
  std::vector<Index> numbers_;
  Coding::Models models_;
};

std::vector<std::byte> PartWriter::coarsest(Index input_count) {
  std::vector<Triangle> triangles;
  for (Index t = 0; t < mesh_.triangle_count(); ++t) {
    if (mesh_.destroyer[t] != kNone) continue;
    for (const Index corner : mesh_.triangles[t]) {
      if (file_of_[corner] != kNone) continue;
      file_of_[corner] = growth.add_vertex();
      vertices.push_back(corner);
    }
    grown_[t] = static_cast<Index>(triangles.size());
    triangles.push_back(mesh_.triangles[t]);
    for (Index& corner : triangles.back()) corner = file_of_[corner];
  }
  for (const Triangle& t : triangles) growth.add_coarsest(t);
  RangeEncoder coder;
  MeshCoding<RangeEncoder> meshes(coder, growth.vertex_count(), triangles.size());
  for (Triangle t : triangles) meshes.code(t);
  Coding coding(coder, models_, growth, lattice, numbers_, input_count);
  for (const Index v : vertices) {
    Lattice position = quantizer_.lattice(positions_[v]);
    Index number_of_it = number(v);
    coding.coarsest(position, number_of_it);
  }
  std::vector<std::byte> coded = coder.finish(), payload;
  append_little_endian(payload, growth.vertex_count());
  append_little_endian(payload, static_cast<Index>(triangles.size()));
  append_little_endian(payload, mesh_.operation_count());
  append_little_endian(payload, mesh_.level_count());
  for (Index level = 1; level <= mesh_.level_count(); ++level) append_little_endian(payload, mesh_.level_begin[level]);
  const std::size_t least = (growth.vertex_count() + triangles.size() + kMostPerMeshByte - 1) / kMostPerMeshByte;
  coded.resize(std::max(coded.size(), least));
  payload.insert(payload.end(), coded.begin(), coded.end());
  return payload;
}

// The triangles that have come are those that the operation destroys, in some order and rotation.
bool PartWriter::take_brought(Index operation) {
  const auto destroyed = mesh_.destroyed_by(operation);
  if (growth.brought().size() != destroyed.size()) return false;
  for (const Index t : growth.brought()) {
    Triangle corners = growth.triangle(t);
    for (Index& corner : corners) corner = corner < vertices.size() ? vertices[corner] : kNone;
    const auto same = [&](Index d) {
      Triangle other = mesh_.triangles[d];
      for (int i = 0; i < 3; ++i) {
        if (other == corners) return grown_[d] == kNone;
        std::rotate(other.begin(), other.begin() + 1, other.end());
      }
      return false;
    };
    const auto found = std::find_if(destroyed.begin(), destroyed.end(), same);
    if (found == destroyed.end()) return false;
    grown_[*found] = t;
  }
  return true;
}

// At a border: the vertex lies before or behind the one that is kept.
Refinement PartWriter::removal_kind(Index removal) const {
  const auto destroyed = mesh_.destroyed_by(removal);
  if (destroyed.size() != 2) return destroyed.size() == 4 ? Refinement::kFour : Refinement::kThree;
  const Index s = mesh_.triangles[mesh_.created_begin[removal]][1];
  const auto has_s = [&](Index t) {
    return std::find(mesh_.triangles[t].begin(), mesh_.triangles[t].end(), s) != mesh_.triangles[t].end();
  };
  return has_s(destroyed[0]) && has_s(destroyed[1]) ? Refinement::kBorderFirst : Refinement::kBorderLast;
}

bool PartWriter::cluster(Coding& coding, Index first, Index removal) {
  if (!mesh_.is_removal(removal)) return false;
  const Index v = mesh_.vertex[removal], u = mesh_.kept(removal);
  if (file_of_[u] == kNone || file_of_[v] != kNone || grown_[mesh_.created_begin[removal]] == kNone) return false;
  FourKRemoval r{.kept = file_of_[u],
                 .place = place_of(u, mesh_.created_begin[removal]),
                 .position = quantizer_.lattice(positions_[v]),
                 .number = number(v),
                 .error = quantized_error(mesh_.error[removal]),
                 .swap_count = removal - first};
  r.kind = removal_kind(removal);
  file_of_[v] = growth.vertex_count();
  vertices.push_back(v);
  if (!coding.removal(r) || !take_brought(removal)) return false;
  for (Index o = removal; o-- > first;) {
    if (mesh_.is_removal(o) || mesh_.vertex[o] != v || mesh_.created_count(o) != 2) return false;
    Index told = mesh_.created_begin[o];
    const Triangle& corners = mesh_.triangles[told];
    if (std::find(corners.begin(), corners.end(), v) == corners.end()) ++told;
    FourKSwap s{.place = place_of(v, told), .error = quantized_error(mesh_.error[o])};
    if (s.error > r.error || s.place >= growth.star(file_of_[v]).size()) return false;
    if (!coding.swap(r.error, s) || !take_brought(o)) return false;
  }
  return true;
}

bool PartWriter::clusters(std::span<const Index> begins, Index end, Index input_count,
                          std::vector<std::byte>& payload) {
  RangeEncoder coder;
  Coding coding(coder, models_, growth, lattice, numbers_, input_count);
  for (std::size_t i = begins.size(); i-- > 0;) {
    const Index behind = i + 1 < begins.size() ? begins[i + 1] : end;
    if (!cluster(coding, begins[i], behind - 1)) return false;
  }
  const Index operations = end - begins.front();
  payload.clear();
  append_little_endian(payload, static_cast<Index>(begins.size()));
  std::vector<std::byte> coded = coder.finish();
  coded.resize(std::max<std::size_t>(coded.size(), (operations + kMostOperationsPerByte - 1) / kMostOperationsPerByte));
  payload.insert(payload.end(), coded.begin(), coded.end());
  return true;
}

}  // namespace

struct FourKEncoder::File {
  ByteSink sink;
  FourKHeader header;
  std::uint32_t key_interval = 1;
  Quantizer quantizer;
  std::uint64_t offset = 0;
  std::uint32_t parts = 0, frames = 1;

  // Of a clip: the only part, in the order of the file.
  FourKGrowth growth;
  std::vector<Index> vertices, operations;  // of the mesh
  std::vector<Lattice> first, before;       // positions of frame 0 and of the last frame
  std::vector<std::int32_t> first_errors, errors_before;

  // Parts that wait for the first.
  bool first_part_last = false, holds_now = false;
  std::vector<std::vector<std::byte>> held;

  Result<void> write(std::span<const std::byte> bytes) {
    if (holds_now) {
      held.emplace_back(bytes.begin(), bytes.end());
      return {};
    }
    offset += bytes.size();
    return sink(bytes);
  }
  Result<void> write_chunk(std::uint32_t kind, std::uint32_t number, std::span<const std::byte> payload);
  Result<void> check(std::span<const Vec3f> positions) const;
  void keep(const FourKMesh& mesh, PartWriter&& writer);
};

Result<void> FourKEncoder::File::write_chunk(std::uint32_t kind, std::uint32_t number,
                                             std::span<const std::byte> payload) {
  if (payload.size() > std::numeric_limits<std::uint32_t>::max())
    return Error{ErrorCode::kUnsupported, "", "a chunk would be larger than 4 GiB"};
  if (Result<void> written = write(chunk_header(kind, number, payload)); !written) return written;
  return write(payload);
}

Result<void> FourKEncoder::File::check(std::span<const Vec3f> positions) const {
  for (std::size_t v = 0; v < positions.size(); ++v) {
    if (is_finite(positions[v]) && quantizer.fits(positions[v])) continue;
    const std::string where = "vertex " + std::to_string(v);
    if (!is_finite(positions[v])) return Error{ErrorCode::kBadInput, where, "its position is not a finite number"};
    return Error{ErrorCode::kUnsupported, where, "lies too far away for the tolerance; store the file losslessly"};
  }
  return {};
}

void FourKEncoder::File::keep(const FourKMesh& mesh, PartWriter&& writer) {
  growth = std::move(writer.growth);
  vertices = std::move(writer.vertices);
  first = before = std::move(writer.lattice);
  for (Index o = mesh.operation_count(); o-- > 0;) {
    operations.push_back(o);
    first_errors.push_back(quantized_error(mesh.error[o]));
  }
  errors_before = first_errors;
}

FourKEncoder::FourKEncoder(ByteSink sink) : file_(std::make_unique<File>()) { file_->sink = std::move(sink); }
FourKEncoder::~FourKEncoder() = default;
FourKEncoder::FourKEncoder(FourKEncoder&&) noexcept = default;
FourKEncoder& FourKEncoder::operator=(FourKEncoder&&) noexcept = default;

std::uint64_t FourKEncoder::byte_count() const { return file_->offset; }

Result<void> FourKEncoder::begin(const Box& box, Index input_count, const FourKEncoderOptions& options) {
  assert(options.part_count >= 1 && options.frame_count >= 1 && (options.part_count == 1 || options.frame_count == 1));
  FourKHeader& h = file_->header;
  h.part_count = options.part_count;
  h.frame_count = options.frame_count;
  h.first_frame_number = options.first_frame_number;
  h.frames_per_second = options.frames_per_second;
  h.diagonal = box.empty() ? 0 : box.diagonal();
  h.vertex_count = input_count;
  if (!options.lossless && !box.empty()) {
    const LatticeChoice choice = choose_lattice(options.tolerance * h.diagonal, box);
    h.origin = choice.origin;
    h.step = choice.step;
    h.tolerance = choice.step == 0 ? 0 : options.tolerance * h.diagonal;
  }
  file_->key_interval = options.key_interval;
  file_->first_part_last = options.first_part_last && options.part_count > 1;
  file_->quantizer = Quantizer(h.origin, h.step);
  std::vector<std::byte> bytes;
  for (const std::uint8_t byte : kMagic) bytes.push_back(static_cast<std::byte>(byte));
  append_little_endian(bytes, kStreamVersion);
  if (Result<void> written = file_->write(bytes); !written) return written;
  bytes.clear();
  append_little_endian(bytes, std::uint32_t{0});
  append_little_endian(bytes, h.part_count);
  append_little_endian(bytes, h.frame_count);
  append_little_endian(bytes, h.first_frame_number);
  for (const double x : {h.frames_per_second, h.origin.x, h.origin.y, h.origin.z, h.step, h.tolerance, h.diagonal})
    append_double(bytes, x);
  append_little_endian(bytes, h.vertex_count);
  return file_->write_chunk(kFourKChunk, 0, bytes);
}

Result<void> FourKEncoder::add_part(const FourKMesh& mesh, std::span<const Vec3f> positions,
                                    std::span<const Index> numbers) {
  assert(positions.size() == mesh.vertex_count && (numbers.empty() || numbers.size() == mesh.vertex_count));
  if (Result<void> good = file_->check(positions); !good) return good;
  const bool is_first = !file_->first_part_last || file_->parts + 1 == file_->header.part_count;
  const std::uint32_t number = !file_->first_part_last ? file_->parts : is_first ? 0 : file_->parts + 1;
  file_->holds_now = !is_first;
  const std::vector<Index> begins = cluster_begins(mesh);
  PartWriter writer(mesh, positions, numbers, file_->quantizer);
  const Index input_count = file_->header.vertex_count;
  if (Result<void> written = file_->write_chunk(kPartChunk, number, writer.coarsest(input_count)); !written)
    return written;
  std::vector<std::byte> payload;
  std::uint32_t chunk = 0;
  Index end = mesh.operation_count();
  for (std::size_t left = begins.size(); left > 0; ++chunk) {
    const std::size_t count = std::min<std::size_t>(left, kClustersPerChunk);
    left -= count;
    if (!writer.clusters(std::span(begins).subspan(left, count), end, input_count, payload)) return not_clusters();
    if (Result<void> written = file_->write_chunk(kRefineChunk, chunk, payload); !written) return written;
    end = begins[left];
  }
  if (file_->header.frame_count > 1) file_->keep(mesh, std::move(writer));
  ++file_->parts;
  file_->holds_now = false;
  if (!file_->first_part_last || !is_first) return {};
  for (const std::vector<std::byte>& bytes : file_->held)
    if (Result<void> written = file_->write(bytes); !written) return written;
  file_->held.clear();
  return {};
}

Result<void> FourKEncoder::add_frame(std::span<const Vec3f> positions, std::span<const float> errors) {
  File& f = *file_;
  assert(f.parts == 1 && errors.size() == f.operations.size());
  if (Result<void> good = f.check(positions); !good) return good;
  const bool key = f.frames % f.key_interval == 0;
  const std::vector<Lattice>& from = key ? f.first : f.before;
  std::vector<Lattice> now(f.vertices.size());
  RangeEncoder coder;
  LatticeModels models;
  code_pose(
      coder, models, [&](Index v) { return f.growth.parents(v); }, from, now,
      [&](Index v) { return f.quantizer.lattice(positions[f.vertices[v]]); });
  std::vector<std::int32_t> errors_now = key ? f.first_errors : f.errors_before;
  code_pose_errors(coder, errors_now, [&](std::size_t i) { return quantized_error(errors[f.operations[i]]); });
  std::vector<std::byte> payload;
  append_little_endian(payload, key ? 0u : f.frames - 1);
  std::ranges::copy(coder.finish(), std::back_inserter(payload));
  if (Result<void> written = f.write_chunk(kPoseChunk, f.frames, payload); !written) return written;
  f.before = std::move(now);
  f.errors_before = std::move(errors_now);
  ++f.frames;
  return {};
}

Result<void> FourKEncoder::finish() {
  File& f = *file_;
  if (f.parts != f.header.part_count || f.frames != f.header.frame_count)
    return Error{ErrorCode::kMismatch, "", "there are other numbers of parts or frames than announced"};
  const std::uint64_t end = f.offset;
  if (Result<void> written = f.write_chunk(kFourKEndChunk, 0, {}); !written) return written;
  std::vector<std::byte> mark;
  append_little_endian(mark, end);
  for (const std::uint8_t byte : kEndMagic) mark.push_back(static_cast<std::byte>(byte));
  return f.write(mark);
}

}  // namespace limber
