// SPDX-License-Identifier: Apache-2.0
// What stands in a PLY file, and how, as its header tells.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "limber/base/result.h"

namespace limber {

enum class PlyEncoding { kText, kLittleEndian, kBigEndian };

enum class PlyType : std::uint8_t { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat32, kFloat64 };

std::size_t ply_type_size(PlyType type);

// What limber reads of a row.
enum class PlyRole : std::uint8_t { kIgnored, kX, kY, kZ, kCorners };

struct PlyProperty {
  PlyType type = PlyType::kFloat32;
  std::optional<PlyType> count_type;  // of a list
  PlyRole role = PlyRole::kIgnored;
};

struct PlyElement {
  std::string_view name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::kText;
  std::vector<PlyElement> elements;
  std::size_t body_offset = 0;     // in bytes
  std::uint64_t body_line = 1;     // the number of the first line of the body
  std::uint64_t vertex_count = 0;  // of the element `vertex`
};

// The header refers to `bytes`. Errors at a line: kTruncated where the header does not end; kBadInput where it breaks
// a rule, or has no element `vertex` with x, y and z, or no element `face` with a list of corners; kUnsupported for
// triangle strips.
Result<PlyHeader> read_ply_header(std::string_view bytes, std::string_view name);

}  // namespace limber
