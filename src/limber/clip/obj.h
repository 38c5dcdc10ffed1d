// SPDX-License-Identifier: Apache-2.0
// Wavefront OBJ: `v` and `f`, everything else ignored.
#pragma once

#include <string_view>

#include "limber/base/result.h"
#include "limber/clip/mesh_file.h"

namespace limber {

// Corners are v, v/vt, v//vn or v/vt/vn; negative indices count back from the last vertex so far; a face may stand
// before its vertices. Errors as read_mesh, at a line; vertices are numbered from 1, as in the file.
Result<void> read_obj(std::string_view text, std::string_view name, MeshSink& sink);

// Normals become `vn`, one per vertex.
Result<void> write_obj(OutputFile& file, const MeshParts& mesh);

}  // namespace limber
