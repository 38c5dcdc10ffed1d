// SPDX-License-Identifier: Apache-2.0
// Reads a four-face file, as far as it is there (docs/format.md, "Four-face files").
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "limber/base/result.h"
#include "limber/base/vec.h"
#include "limber/fourface/four_k_mesh.h"
#include "limber/stream/four_k_header.h"
#include "limber/stream/quantizer.h"

namespace limber {

// Whether bytes are a four-face file, as far as their beginning says: not another stream, and not anything else.
bool is_four_face_file(std::span<const std::byte> bytes);

struct FourKPart {
  FourKMesh mesh;
  std::vector<Vec3f> positions;  // [mesh.vertex_count], in the first frame
  std::vector<Index> numbers;    // [mesh.vertex_count]: of the input's vertices
  bool is_whole = false;         // else the finest operations have not arrived
};

// What the positions of other frames build on, by vertex and operation.
struct FourKPoseBase {
  std::vector<std::array<Index, 4>> parents;  // kNone where there are fewer
  std::vector<Lattice> positions;
  std::vector<std::int32_t> errors;  // quantized, the last operation first
};

class FourKDecoder {
 public:
  // `bytes` are kept by reference. Errors: kBadInput; kUnsupported; kTruncated where not even the header is whole.
  Result<void> open(std::span<const std::byte> bytes);

  const FourKHeader& header() const { return header_; }
  // Those that have arrived: parts at least in their coarsest mesh, frames whole.
  std::uint32_t part_count() const { return static_cast<std::uint32_t>(parts_.size()); }
  std::uint32_t frame_count() const;
  // All that the header announces is there, and the end mark.
  bool is_whole() const { return is_whole_; }

  // Precondition: part < part_count(). Errors: kBadInput, where bytes are wrong.
  Result<FourKPart> read_part(std::uint32_t part, FourKPoseBase* base = nullptr) const;

  // The frame on which frame `frame` builds. Precondition of both: 0 < frame < frame_count().
  Result<std::uint32_t> builds_on(std::uint32_t frame) const;
  // From positions and errors of that frame to those of this one; positions at `from`, not changed.
  Result<void> read_pose(std::uint32_t frame, const FourKPoseBase& base, std::span<const Lattice> from,
                         std::span<Lattice> now, std::span<std::int32_t> errors) const;

  Quantizer quantizer() const { return {header_.origin, header_.step}; }
  std::uint64_t part_bytes(std::uint32_t part) const { return parts_[part].byte_count; }

 private:
  struct Part {
    std::uint64_t offset = 0, byte_count = 0;
    std::vector<std::uint64_t> chunks;  // of clusters
  };
  struct PartState;

  Result<void> scan(std::uint64_t offset);
  Result<std::span<const std::byte>> payload_at(std::uint64_t offset) const;
  Result<void> read_coarsest(std::uint64_t offset, PartState& state) const;
  Result<void> read_clusters(std::uint64_t offset, PartState& state) const;

  std::span<const std::byte> bytes_;
  FourKHeader header_;
  std::vector<Part> parts_;
  std::vector<std::uint64_t> poses_;
  bool is_whole_ = false;
};

}  // namespace limber
