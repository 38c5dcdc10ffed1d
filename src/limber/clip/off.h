// SPDX-License-Identifier: Apache-2.0
// The Object File Format of Geomview, as text: a vertex per line, a face per line.
#pragma once

#include <string_view>

#include "limber/base/result.h"
#include "limber/clip/mesh_file.h"

namespace limber {

// OFF, COFF, NOFF, STOFF and their combinations: normals, colours and texture coordinates, and whatever else stands
// behind the position or the corners, are ignored. Binary files and those of other dimensions (4OFF, nOFF) are
// kUnsupported. Faces of one or two corners, which the format allows, are skipped. Errors as read_mesh, at a line;
// vertices are numbered from 0, as in the file.
Result<void> read_off(std::string_view text, std::string_view name, MeshSink& sink);

// NOFF where there are normals.
Result<void> write_off(OutputFile& file, const MeshParts& mesh);

}  // namespace limber
