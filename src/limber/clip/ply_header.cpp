// SPDX-License-Identifier: Apache-2.0
#include "limber/clip/ply_header.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <utility>

#include "limber/clip/text_scanner.h"

namespace limber {
namespace {

constexpr std::array<std::pair<std::string_view, PlyType>, 16> kTypeNames{{
    {"char", PlyType::kInt8},
    {"int8", PlyType::kInt8},
    {"uchar", PlyType::kUint8},
    {"uint8", PlyType::kUint8},
    {"short", PlyType::kInt16},
    {"int16", PlyType::kInt16},
    {"ushort", PlyType::kUint16},
    {"uint16", PlyType::kUint16},
    {"int", PlyType::kInt32},
    {"int32", PlyType::kInt32},
    {"uint", PlyType::kUint32},
    {"uint32", PlyType::kUint32},
    {"float", PlyType::kFloat32},
    {"float32", PlyType::kFloat32},
    {"double", PlyType::kFloat64},
    {"float64", PlyType::kFloat64},
}};

std::optional<PlyType> type_named(std::string_view name) {
  for (const auto& [type_name, type] : kTypeNames) {
    if (type_name == name) return type;
  }
  return std::nullopt;
}

PlyRole role_of(std::string_view element, std::string_view property, bool is_list) {
  if (element == "vertex" && !is_list) {
    if (property == "x") return PlyRole::kX;
    if (property == "y") return PlyRole::kY;
    if (property == "z") return PlyRole::kZ;
  }
  if (element == "face" && is_list && (property == "vertex_indices" || property == "vertex_index")) {
    return PlyRole::kCorners;
  }
  return PlyRole::kIgnored;
}

bool has_role(const PlyElement& element, PlyRole role) {
  return std::any_of(element.properties.begin(), element.properties.end(),
                     [&](const PlyProperty& property) { return property.role == role; });
}

class PlyHeaderReader {
 public:
  PlyHeaderReader(std::string_view bytes, std::string_view name) : bytes_(bytes), name_(name), scanner_(bytes) {}

  Result<PlyHeader> read() {
    if (scanner_.word() != "ply") return error("a PLY file must start with the word ply");
    scanner_.skip_line();
    if (Result<void> done = read_format(); !done) return done.error();
    while (true) {
      scanner_.skip_to_word();
      if (scanner_.at_end()) {
        return error_at_line(ErrorCode::kTruncated, name_, scanner_.line(), "the file ends inside its header");
      }
      const std::string_view keyword = scanner_.word();
      if (keyword == "end_header") break;
      if (keyword == "element") {
        if (Result<void> done = read_element(); !done) return done.error();
      } else if (keyword == "property") {
        if (Result<void> done = read_property(); !done) return done.error();
      } else if (keyword != "comment" && keyword != "obj_info") {
        return error(
            fmt::format("the header has a line that starts with `{}`, which is not PLY", keyword.substr(0, 40)));
      }
      scanner_.skip_line();
    }
    if (Result<void> done = find_parts(); !done) return done.error();
    end_header();
    return header_;
  }

 private:
  Error error(std::string what) const {
    return error_at_line(ErrorCode::kBadInput, name_, scanner_.line(), std::move(what));
  }

  Result<void> read_format() {
    scanner_.skip_to_word();
    std::string_view keyword = scanner_.word();
    while (keyword == "comment" || keyword == "obj_info") {
      scanner_.skip_line();
      scanner_.skip_to_word();
      keyword = scanner_.word();
    }
    const std::string_view encoding = keyword == "format" ? scanner_.word() : std::string_view{};
    if (encoding == "ascii") {
      header_.encoding = PlyEncoding::kText;
    } else if (encoding == "binary_little_endian") {
      header_.encoding = PlyEncoding::kLittleEndian;
    } else if (encoding == "binary_big_endian") {
      header_.encoding = PlyEncoding::kBigEndian;
    } else {
      return error("a PLY header must go on with `format`, and ascii, binary_little_endian or binary_big_endian");
    }
    scanner_.skip_line();
    return {};
  }

  Result<void> read_element() {
    PlyElement element;
    element.name = scanner_.word();
    std::int64_t count = 0;
    if (element.name.empty() || !scanner_.read(count) || count < 0) {
      return error("an element needs a name and a count: element vertex 8");
    }
    for (const PlyElement& other : header_.elements) {
      if (other.name == element.name) return error("an element of this name stands in the header before");
    }
    element.count = static_cast<std::uint64_t>(count);
    header_.elements.push_back(std::move(element));
    return {};
  }

  Result<void> read_property() {
    if (header_.elements.empty()) return error("a property must stand behind the element that it belongs to");
    PlyElement& element = header_.elements.back();
    PlyProperty property;
    std::string_view type_name = scanner_.word();
    const bool is_list = type_name == "list";
    if (is_list) {
      property.count_type = type_named(scanner_.word());
      type_name = scanner_.word();
    }
    const std::optional<PlyType> type = type_named(type_name);
    const std::string_view property_name = scanner_.word();
    if (!type || property_name.empty() || (is_list && !property.count_type)) {
      return error("a property needs a type and a name: property float x, or property list uchar int vertex_indices");
    }
    property.type = *type;
    property.role = role_of(element.name, property_name, is_list);
    if (property.role != PlyRole::kIgnored && has_role(element, property.role)) property.role = PlyRole::kIgnored;
    element.properties.push_back(property);
    return {};
  }

  // Are the vertices and faces there?
  Result<void> find_parts() {
    const PlyElement* vertex = nullptr;
    const PlyElement* face = nullptr;
    bool strips = false;
    for (const PlyElement& element : header_.elements) {
      if (element.name == "vertex") vertex = &element;
      if (element.name == "face") face = &element;
      if (element.name == "tristrips") strips = true;
    }
    if (!vertex || !has_role(*vertex, PlyRole::kX) || !has_role(*vertex, PlyRole::kY) ||
        !has_role(*vertex, PlyRole::kZ)) {
      return error("the header has no element `vertex` with the properties x, y and z");
    }
    if (!face && strips) {
      return error_at_line(ErrorCode::kUnsupported, name_, scanner_.line(),
                           "triangle strips are not read; save the mesh with a face per triangle");
    }
    if (!face || !has_role(*face, PlyRole::kCorners)) {
      return error("has no faces: the header has no element `face` with a list `vertex_indices`");
    }
    header_.vertex_count = vertex->count;
    return {};
  }

  // A binary body may start with any byte, so that only the first line can tell whether lines end with a lone CR.
  void end_header() {
    const std::size_t first_end = bytes_.find_first_of("\r\n");
    const bool lone_cr = bytes_[first_end] == '\r' && bytes_.substr(first_end, 2) != "\r\n";
    const std::size_t end = bytes_.find(lone_cr ? '\r' : '\n', bytes_.size() - scanner_.remaining());
    header_.body_offset = end == std::string_view::npos ? bytes_.size() : end + 1;
    header_.body_line = scanner_.line() + 1;
  }

  std::string_view bytes_;
  std::string_view name_;
  TextScanner scanner_;
  PlyHeader header_;
};

}  // namespace

std::size_t ply_type_size(PlyType type) {
  constexpr std::array<std::size_t, 8> kSizes{1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

Result<PlyHeader> read_ply_header(std::string_view bytes, std::string_view name) {
  return PlyHeaderReader(bytes, name).read();
}

}  // namespace limber
