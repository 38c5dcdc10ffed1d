// SPDX-License-Identifier: Apache-2.0
#include "limber/clip/mesh_file.h"

#include <system_error>

#include "limber/clip/input_file.h"
#include "limber/clip/obj.h"
#include "limber/clip/off.h"
#include "limber/clip/output_file.h"
#include "limber/clip/ply.h"

namespace limber {
namespace {

Error unknown_extension(const std::filesystem::path& path) {
  return {ErrorCode::kUnsupported, path.string(),
          "is no mesh file that limber knows; the extensions are .obj .ply .off"};
}

}  // namespace

std::optional<MeshFormat> mesh_format(const std::filesystem::path& path) {
  const std::string extension = lower_case_extension(path);
  if (extension == ".obj") return MeshFormat::kObj;
  if (extension == ".ply") return MeshFormat::kPly;
  if (extension == ".off") return MeshFormat::kOff;
  return std::nullopt;
}

Result<void> read_mesh(std::string_view bytes, const std::filesystem::path& path, MeshSink& sink) {
  const std::optional<MeshFormat> format = mesh_format(path);
  if (!format) return unknown_extension(path);
  const std::string name = path.string();
  if (bytes.empty()) return Error{ErrorCode::kTruncated, name, "the file is empty"};
  const auto read = *format == MeshFormat::kObj ? read_obj : *format == MeshFormat::kPly ? read_ply : read_off;
  if (Result<void> done = read(bytes, name, sink); !done) return done;
  if (sink.vertex_count() >= kNone || sink.triangle_count() >= kNone) {
    return Error{ErrorCode::kUnsupported, name, "has more vertices or triangles than 32-bit indices can name"};
  }
  if (sink.triangle_count() == 0) return Error{ErrorCode::kBadInput, name, "has no faces; a clip is made of triangles"};
  return {};
}

Result<MeshFile> read_mesh(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!mesh_format(path) && std::filesystem::is_regular_file(path, ignored)) return unknown_extension(path);
  std::string bytes;
  if (Result<void> done = read_file(path, bytes); !done) return done.error();
  MeshFile file;
  MeshSink sink = MeshSink::collecting(file.positions, file.mesh.triangles);
  if (Result<void> done = read_mesh(bytes, path, sink); !done) return done.error();
  file.mesh.vertex_count = static_cast<Index>(file.positions.size());
  return file;
}

Result<void> write_mesh(OutputFile& file, MeshFormat format, const MeshParts& mesh, const MeshWriteOptions& options) {
  assert(mesh.normals.empty() || mesh.normals.size() == mesh.positions.size());
  switch (format) {
    case MeshFormat::kObj:
      return write_obj(file, mesh);
    case MeshFormat::kOff:
      return write_off(file, mesh);
    case MeshFormat::kPly:
      break;
  }
  return options.text ? write_ply_text(file, mesh) : write_ply_binary(file, mesh);
}

Result<void> write_mesh(const std::filesystem::path& path, const MeshParts& mesh, const MeshWriteOptions& options) {
  const std::optional<MeshFormat> format = mesh_format(path);
  if (!format) return unknown_extension(path);
  Result<OutputFile> file = OutputFile::create(path, options.replace);
  if (!file) return file.error();
  if (Result<void> done = write_mesh(*file, *format, mesh, options); !done) return done;
  return file->commit();
}

}  // namespace limber
