// SPDX-License-Identifier: Apache-2.0
#include "limber/clip/off.h"

#include <algorithm>
#include <fmt/format.h>
#include <vector>

#include "limber/clip/mesh_text.h"
#include "limber/clip/text_scanner.h"

namespace limber {
namespace {

class OffReader {
 public:
  OffReader(std::string_view text, std::string_view name, MeshSink& sink) : scanner_(text), name_(name), sink_(sink) {}

  Result<void> read() {
    if (Result<void> done = read_header(); !done) return done;
    for (std::int64_t vertex = 0; vertex < vertex_count_; ++vertex) {
      if (Result<void> done = read_vertex(vertex); !done) return done;
    }
    for (std::int64_t face = 0; face < face_count_; ++face) {
      if (Result<void> done = read_face(face); !done) return done;
    }
    return {};
  }

 private:
  Error error(ErrorCode code, std::string what) const {
    return error_at_line(code, name_, scanner_.line(), std::move(what));
  }

  Result<void> read_header() {
    scanner_.skip_to_word();
    const std::string_view keyword = scanner_.word();
    if (!keyword.ends_with("OFF")) return error(ErrorCode::kBadInput, "an OFF file must start with the word OFF");
    std::string_view kind = keyword.substr(0, keyword.size() - 3);
    for (const std::string_view part : {"ST", "C", "N"}) {
      if (kind.starts_with(part)) kind.remove_prefix(part.size());
    }
    if (!kind.empty()) {
      return error(ErrorCode::kUnsupported,
                   fmt::format("{} files are not read; save it as OFF, with three coordinates per vertex", keyword));
    }
    scanner_.skip_to_word();
    std::int64_t edge_count = 0;
    const bool counted = scanner_.read(vertex_count_) && scanner_.read(face_count_);
    if (!counted && !scanner_.at_end() && scanner_.word() == "BINARY") {
      return error(ErrorCode::kUnsupported, "binary OFF files are not read; save it as text");
    }
    // Files without a count of edges, which nothing needs, are common.
    if (!counted || vertex_count_ < 0 || face_count_ < 0 || !at_line_end_or(scanner_.read(edge_count))) {
      return error(ErrorCode::kBadInput, "the header must give the numbers of vertices, faces and edges");
    }
    scanner_.skip_line();
    // A vertex is five bytes or more, `0 0 0`, a face two, `0` and a line end.
    const auto bytes = static_cast<std::int64_t>(scanner_.remaining());
    if (vertex_count_ > (bytes + 1) / 6 || face_count_ > (bytes + 1) / 2) {
      return error(ErrorCode::kTruncated, fmt::format("the file is too short for the {} vertices and {} faces that its "
                                                      "header promises",
                                                      vertex_count_, face_count_));
    }
    sink_.reserve(static_cast<std::size_t>(vertex_count_), static_cast<std::size_t>(std::min(face_count_, bytes / 8)));
    return {};
  }

  bool at_line_end_or(bool read) {
    scanner_.skip_blanks();
    return read || scanner_.at_line_end();
  }

  Result<void> read_vertex(std::int64_t vertex) {
    scanner_.skip_to_word();
    if (scanner_.at_end()) {
      return error(ErrorCode::kTruncated, fmt::format("the file ends after {} of {} vertices", vertex, vertex_count_));
    }
    Vec3f position;
    if (!scanner_.read(position.x) || !scanner_.read(position.y) || !scanner_.read(position.z)) {
      return error(ErrorCode::kBadInput, fmt::format("vertex {} needs a line of three numbers: x y z", vertex));
    }
    if (!is_finite(position)) {
      return error(ErrorCode::kBadInput, fmt::format("the position of vertex {} is not finite", vertex));
    }
    sink_.add_vertex(position);
    scanner_.skip_line();
    return {};
  }

  Result<void> read_face(std::int64_t face) {
    scanner_.skip_to_word();
    if (scanner_.at_end()) {
      return error(ErrorCode::kTruncated, fmt::format("the file ends after {} of {} faces", face, face_count_));
    }
    std::int64_t corner_count = 0;
    if (!scanner_.read(corner_count) || corner_count < 0) {
      return error(ErrorCode::kBadInput, fmt::format("face {} must start with the number of its corners", face));
    }
    corners_.clear();
    for (std::int64_t i = 0; i < corner_count; ++i) {
      std::int64_t corner = 0;
      if (!scanner_.read(corner)) {
        return error(
            scanner_.at_end() ? ErrorCode::kTruncated : ErrorCode::kBadInput,
            fmt::format("face {} needs a line of {} vertex numbers behind the {}", face, corner_count, corner_count));
      }
      if (corner < 0 || corner >= vertex_count_) {
        return error(ErrorCode::kBadInput,
                     fmt::format("face {} names vertex {}, but vertices are numbered from 0 to {}", face, corner,
                                 vertex_count_ - 1));
      }
      corners_.push_back(static_cast<Index>(corner));
    }
    sink_.add_face(corners_);
    scanner_.skip_line();
    return {};
  }

  TextScanner scanner_;
  std::string_view name_;
  MeshSink& sink_;
  std::int64_t vertex_count_ = 0;
  std::int64_t face_count_ = 0;
  std::vector<Index> corners_;
};

}  // namespace

Result<void> read_off(std::string_view text, std::string_view name, MeshSink& sink) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  return OffReader(text, name, sink).read();
}

Result<void> write_off(OutputFile& file, const MeshParts& mesh) {
  OutputBuffer out(file);
  out.append(mesh.normals.empty() ? "OFF\n" : "NOFF\n");
  out.append_integer(mesh.positions.size()).append(" ").append_integer(mesh.triangles.size()).append(" 0\n");
  append_text_body(mesh, out);
  return out.finish();
}

}  // namespace limber
