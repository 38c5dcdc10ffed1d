// SPDX-License-Identifier: Apache-2.0
// The Stanford PLY format: text, binary little endian and binary big endian.
#pragma once

#include <string_view>

#include "limber/base/result.h"
#include "limber/clip/mesh_file.h"

namespace limber {

// Reads x, y and z of the element `vertex` and the list `vertex_indices` (or `vertex_index`) of the element `face`,
// of any scalar types and among any other properties and elements, in any order. Faces of fewer than three corners
// are skipped; triangle strips are kUnsupported. Errors as read_mesh, at a line or byte; vertices and faces are
// numbered from 0.
Result<void> read_ply(std::string_view bytes, std::string_view name, MeshSink& sink);

// Normals become nx, ny and nz.
Result<void> write_ply_binary(OutputFile& file, const MeshParts& mesh);
Result<void> write_ply_text(OutputFile& file, const MeshParts& mesh);

}  // namespace limber
