// SPDX-License-Identifier: Apache-2.0
#include "limber/clip/ply.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <fmt/format.h>
#include <string>
#include <vector>

#include "limber/clip/byte_order.h"
#include "limber/clip/mesh_text.h"
#include "limber/clip/ply_header.h"
#include "limber/clip/text_scanner.h"

namespace limber {
namespace {

bool is_floating(PlyType type) { return type == PlyType::kFloat32 || type == PlyType::kFloat64; }

// The body of a text file as a row of numbers. An integer or float is a double without loss; positions given as
// doubles are rounded to float.
class TextValues {
 public:
  TextValues(std::string_view body, std::uint64_t line) : scanner_(body, line) {}

  bool read(PlyType type, double& value) {
    scanner_.skip_to_word();
    float number = 0;
    std::int64_t integer = 0;
    if (is_floating(type)) {
      if (!scanner_.read(number)) return false;
      value = static_cast<double>(number);
    } else {
      if (!scanner_.read(integer)) return false;
      value = static_cast<double>(integer);
    }
    return true;
  }

  // A number is a byte or more, and a blank between two.
  std::size_t value_size(PlyType) const { return 2; }
  std::size_t remaining() const { return scanner_.remaining() + 1; }
  bool at_end() const { return scanner_.at_end(); }
  std::string place(std::string_view name) const { return fmt::format("{}:{}", name, scanner_.line()); }

 private:
  TextScanner scanner_;
};

template <std::endian kOrder>
class BinaryValues {
 public:
  BinaryValues(std::string_view bytes, std::size_t body_offset) : bytes_(bytes), next_(body_offset) {}

  bool read(PlyType type, double& value) {
    const std::size_t size = ply_type_size(type);
    if (remaining() < size) return false;
    const char* bytes = bytes_.data() + next_;
    next_ += size;
    switch (type) {
      case PlyType::kInt8:
        value = std::bit_cast<std::int8_t>(load<std::uint8_t, kOrder>(bytes));
        break;
      case PlyType::kUint8:
        value = load<std::uint8_t, kOrder>(bytes);
        break;
      case PlyType::kInt16:
        value = std::bit_cast<std::int16_t>(load<std::uint16_t, kOrder>(bytes));
        break;
      case PlyType::kUint16:
        value = load<std::uint16_t, kOrder>(bytes);
        break;
      case PlyType::kInt32:
        value = std::bit_cast<std::int32_t>(load<std::uint32_t, kOrder>(bytes));
        break;
      case PlyType::kUint32:
        value = load<std::uint32_t, kOrder>(bytes);
        break;
      case PlyType::kFloat32:
        value = static_cast<double>(load_float<kOrder>(bytes));
        break;
      case PlyType::kFloat64:
        value = std::bit_cast<double>(load<std::uint64_t, kOrder>(bytes));
        break;
    }
    return true;
  }

  std::size_t value_size(PlyType type) const { return ply_type_size(type); }
  std::size_t remaining() const { return bytes_.size() - next_; }
  bool at_end() const { return true; }
  std::string place(std::string_view name) const { return fmt::format("{}, byte {}", name, next_); }

 private:
  std::string_view bytes_;
  std::size_t next_;
};

template <class Values>
class PlyBodyReader {
 public:
  PlyBodyReader(Values values, const PlyHeader& header, std::string_view name, MeshSink& sink)
      : values_(std::move(values)), header_(header), name_(name), sink_(sink) {}

  Result<void> read() {
    for (const PlyElement& element : header_.elements) {
      if (Result<void> done = read_element(element); !done) return done;
    }
    return {};
  }

 private:
  Error error(ErrorCode code, std::string what) const { return {code, values_.place(name_), std::move(what)}; }

  // Either the file ends, or there is text that is no number.
  Error no_value(const PlyElement& element, std::uint64_t row) const {
    if (values_.at_end()) {
      return error(ErrorCode::kTruncated,
                   fmt::format("the file ends in {} {} of {}", element.name, row, element.count));
    }
    return error(ErrorCode::kBadInput,
                 fmt::format("{} {} has something else than the number that the header promises", element.name, row));
  }

  Result<void> read_element(const PlyElement& element) {
    // Rows without properties take no bytes, however many the header claims.
    if (element.properties.empty()) return {};
    std::size_t row_size = 0;
    for (const PlyProperty& property : element.properties) {
      row_size += values_.value_size(property.count_type.value_or(property.type));
    }
    if (element.count > values_.remaining() / row_size) {
      return error(ErrorCode::kTruncated,
                   fmt::format("the rest of the file is too short for {} rows of element {}, which the header promises",
                               element.count, element.name));
    }
    const bool is_vertex = element.name == "vertex";
    const bool is_face = element.name == "face";
    const auto rows = static_cast<std::size_t>(element.count);
    // A triangle is four values, of a byte or more.
    sink_.reserve(is_vertex ? rows : 0, is_face ? std::min(rows, values_.remaining() / 4) : 0);
    for (std::uint64_t row = 0; row < element.count; ++row) {
      for (const PlyProperty& property : element.properties) {
        if (Result<void> done = read_property(element, row, property); !done) return done;
      }
      if (is_vertex) {
        if (!is_finite(position_)) {
          return error(ErrorCode::kBadInput, fmt::format("the position of vertex {} is not finite", row));
        }
        sink_.add_vertex(position_);
      }
      if (is_face) sink_.add_face(corners_);
    }
    return {};
  }

  Result<void> read_property(const PlyElement& element, std::uint64_t row, const PlyProperty& property) {
    double value = 0;
    if (!property.count_type) {
      if (!values_.read(property.type, value)) return no_value(element, row);
      if (property.role == PlyRole::kX) position_.x = static_cast<float>(value);
      if (property.role == PlyRole::kY) position_.y = static_cast<float>(value);
      if (property.role == PlyRole::kZ) position_.z = static_cast<float>(value);
      return {};
    }
    if (!values_.read(*property.count_type, value)) return no_value(element, row);
    // The comparison is false for what is not a number.
    if (!(value >= 0 && value <= static_cast<double>(kNone))) {
      return error(ErrorCode::kBadInput, fmt::format("{} {} has a list of {} values", element.name, row, value));
    }
    const auto value_count = static_cast<std::uint64_t>(value);
    const bool is_corners = property.role == PlyRole::kCorners;
    if (is_corners) corners_.clear();
    for (std::uint64_t i = 0; i < value_count; ++i) {
      if (!values_.read(property.type, value)) return no_value(element, row);
      if (!is_corners) continue;
      if (!(value >= 0 && value < static_cast<double>(header_.vertex_count) && value < static_cast<double>(kNone)) ||
          value != std::floor(value)) {
        return error(ErrorCode::kBadInput, fmt::format("face {} names vertex {}, but there are {}, numbered from 0",
                                                       row, value, header_.vertex_count));
      }
      corners_.push_back(static_cast<Index>(value));
    }
    return {};
  }

  Values values_;
  const PlyHeader& header_;
  std::string_view name_;
  MeshSink& sink_;
  Vec3f position_;
  std::vector<Index> corners_;
};

std::string header_text(std::string_view format, const MeshParts& mesh) {
  std::string text = fmt::format("ply\nformat {} 1.0\nelement vertex {}\n", format, mesh.positions.size());
  for (const char* name : {"x", "y", "z"}) text += fmt::format("property float {}\n", name);
  if (!mesh.normals.empty()) {
    for (const char* name : {"nx", "ny", "nz"}) text += fmt::format("property float {}\n", name);
  }
  text += fmt::format("element face {}\nproperty list uchar uint vertex_indices\nend_header\n", mesh.triangles.size());
  return text;
}

// The bytes of `v`, 12.
std::string_view store_vector(const Vec3f& v, char* bytes) {
  store_float<std::endian::little>(v.x, bytes);
  store_float<std::endian::little>(v.y, bytes + 4);
  store_float<std::endian::little>(v.z, bytes + 8);
  return {bytes, 12};
}

}  // namespace

Result<void> read_ply(std::string_view bytes, std::string_view name, MeshSink& sink) {
  const Result<PlyHeader> header = read_ply_header(bytes, name);
  if (!header) return header.error();
  switch (header->encoding) {
    case PlyEncoding::kText:
      break;
    case PlyEncoding::kLittleEndian:
      return PlyBodyReader(BinaryValues<std::endian::little>(bytes, header->body_offset), *header, name, sink).read();
    case PlyEncoding::kBigEndian:
      return PlyBodyReader(BinaryValues<std::endian::big>(bytes, header->body_offset), *header, name, sink).read();
  }
  return PlyBodyReader(TextValues(bytes.substr(header->body_offset), header->body_line), *header, name, sink).read();
}

Result<void> write_ply_binary(OutputFile& file, const MeshParts& mesh) {
  OutputBuffer out(file);
  out.append(header_text("binary_little_endian", mesh));
  char bytes[13];
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    out.append(store_vector(mesh.positions[i], bytes));
    if (!mesh.normals.empty()) out.append(store_vector(mesh.normals[i], bytes));
  }
  for (const Triangle& t : mesh.triangles) {
    bytes[0] = 3;
    for (std::size_t i = 0; i < 3; ++i) store<std::uint32_t, std::endian::little>(t[i], bytes + 1 + 4 * i);
    out.append({bytes, 13});
  }
  return out.finish();
}

Result<void> write_ply_text(OutputFile& file, const MeshParts& mesh) {
  OutputBuffer out(file);
  out.append(header_text("ascii", mesh));
  append_text_body(mesh, out);
  return out.finish();
}

}  // namespace limber
