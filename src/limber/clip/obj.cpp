// SPDX-License-Identifier: Apache-2.0
#include "limber/clip/obj.h"

#include <fmt/format.h>
#include <vector>

#include "limber/clip/output_buffer.h"
#include "limber/clip/text_scanner.h"

namespace limber {
namespace {

class ObjReader {
 public:
  ObjReader(std::string_view text, std::string_view name, MeshSink& sink) : scanner_(text), name_(name), sink_(sink) {}

  Result<void> read() {
    for (scanner_.skip_to_word(); !scanner_.at_end(); scanner_.skip_to_word()) {
      const std::string_view keyword = scanner_.word();
      if (keyword == "v") {
        if (Result<void> done = read_vertex(); !done) return done;
      } else if (keyword == "f") {
        if (Result<void> done = read_face(); !done) return done;
      } else {
        scanner_.skip_line();
      }
    }
    if (largest_corner_ < static_cast<std::int64_t>(sink_.vertex_count())) return {};
    return error_at_line(ErrorCode::kBadInput, name_, largest_corner_line_,
                         fmt::format("the face names vertex {}, but the file has {} vertices", largest_corner_ + 1,
                                     sink_.vertex_count()));
  }

 private:
  Result<void> read_vertex() {
    const std::uint64_t line = scanner_.line();
    Vec3f position;
    if (!scanner_.read(position.x) || !scanner_.read(position.y) || !scanner_.read(position.z)) {
      return error_at_line(ErrorCode::kBadInput, name_, line, "a vertex needs three numbers: v x y z");
    }
    if (!is_finite(position)) {
      return error_at_line(ErrorCode::kBadInput, name_, line,
                           fmt::format("the position of vertex {} is not finite", sink_.vertex_count() + 1));
    }
    sink_.add_vertex(position);
    scanner_.skip_line();
    return {};
  }

  Result<void> read_face() {
    const std::uint64_t line = scanner_.line();
    const auto vertex_count = static_cast<std::int64_t>(sink_.vertex_count());
    corners_.clear();
    for (scanner_.skip_blanks(); !scanner_.at_line_end(); scanner_.skip_blanks()) {
      std::int64_t corner = 0;
      if (!scanner_.read_digits(corner) || !scanner_.skip_rest_of_word("/-0123456789")) {
        return error_at_line(ErrorCode::kBadInput, name_, line, "a corner of a face must be v, v/vt, v//vn or v/vt/vn");
      }
      if (corner == 0 || corner < -vertex_count || corner >= std::int64_t{kNone}) {
        return error_at_line(ErrorCode::kBadInput, name_, line,
                             fmt::format("the face names vertex {}, but vertices are numbered from 1 and {} stand "
                                         "before this line",
                                         corner, vertex_count));
      }
      corner = corner > 0 ? corner - 1 : vertex_count + corner;
      if (corner > largest_corner_) largest_corner_ = corner, largest_corner_line_ = line;
      corners_.push_back(static_cast<Index>(corner));
    }
    if (corners_.size() < 3) {
      return error_at_line(ErrorCode::kBadInput, name_, line, "a face needs three corners or more");
    }
    sink_.add_face(corners_);
    return {};
  }

  TextScanner scanner_;
  std::string_view name_;
  MeshSink& sink_;
  std::vector<Index> corners_;
  std::int64_t largest_corner_ = -1;
  std::uint64_t largest_corner_line_ = 0;
};

}  // namespace

Result<void> read_obj(std::string_view text, std::string_view name, MeshSink& sink) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  return ObjReader(text, name, sink).read();
}

Result<void> write_obj(OutputFile& file, const MeshParts& mesh) {
  OutputBuffer out(file);
  for (const Vec3f& p : mesh.positions) out.append("v ").append_vector(p).append("\n");
  for (const Vec3f& n : mesh.normals) out.append("vn ").append_vector(n).append("\n");
  for (const Triangle& triangle : mesh.triangles) {
    out.append("f");
    for (const Index corner : triangle) {
      const std::uint64_t number = std::uint64_t{corner} + 1;
      out.append(" ").append_integer(number);
      if (!mesh.normals.empty()) out.append("//").append_integer(number);
    }
    out.append("\n");
  }
  return out.finish();
}

}  // namespace limber
