// SPDX-License-Identifier: Apache-2.0
// Single meshes in files: OBJ, PLY and OFF, told apart by the extension of the name.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "limber/base/mesh.h"
#include "limber/base/result.h"
#include "limber/base/vec.h"
#include "limber/clip/mesh_sink.h"

namespace limber {

class OutputFile;

enum class MeshFormat { kObj, kPly, kOff };

// By the extension, in upper or lower case; nothing where it is none of the three.
std::optional<MeshFormat> mesh_format(const std::filesystem::path& path);

struct MeshFile {
  Mesh mesh;
  std::vector<Vec3f> positions;  // [mesh.vertex_count], finite
};

// Reads vertices and faces, polygons as fans, and nothing else. Isolated vertices, degenerate and repeated triangles
// stay as they are. Errors: kNotFound, kIo; kUnsupported for an unknown extension or a variant of the format that
// is not read; kTruncated for a file that ends early; kBadInput for text that is no number, a corner that names a
// vertex that is not there, a position that is not finite, a file without faces.
Result<MeshFile> read_mesh(const std::filesystem::path& path);

// The same from the bytes of a file; `name`, whose extension gives the format, stands in errors.
Result<void> read_mesh(std::string_view bytes, const std::filesystem::path& name, MeshSink& sink);

// What a mesh file holds, as the caller has it.
struct MeshParts {
  std::span<const Triangle> triangles;
  std::span<const Vec3f> positions;
  std::span<const Vec3f> normals = {};  // [positions.size()], or none
};

struct MeshWriteOptions {
  bool replace = false;  // may an existing file be replaced?
  bool text = false;     // PLY as text; binary, little endian, otherwise
};

// Writes numbers as the shortest text that reads back as the same float. The file has its name only when it is
// whole. Errors: kUnsupported for an unknown extension, those of OutputFile. Precondition: corners in range.
Result<void> write_mesh(const std::filesystem::path& path, const MeshParts& mesh, const MeshWriteOptions& options = {});

// The same into a file that the caller commits.
Result<void> write_mesh(OutputFile& file, MeshFormat format, const MeshParts& mesh,
                        const MeshWriteOptions& options = {});

}  // namespace limber
