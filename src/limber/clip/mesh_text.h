// SPDX-License-Identifier: Apache-2.0
// What OFF and PLY files as text have in common.
#pragma once

#include "limber/clip/mesh_file.h"
#include "limber/clip/output_buffer.h"

namespace limber {

// A line per vertex, `x y z` and the normal behind it where there is one; then a line per triangle, `3 a b c`, with
// vertices numbered from 0.
inline void append_text_body(const MeshParts& mesh, OutputBuffer& out) {
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    out.append_vector(mesh.positions[i]);
    if (!mesh.normals.empty()) out.append(" ").append_vector(mesh.normals[i]);
    out.append("\n");
  }
  for (const Triangle& t : mesh.triangles) {
    out.append("3 ").append_integer(t[0]).append(" ").append_integer(t[1]).append(" ").append_integer(t[2]).append(
        "\n");
  }
}

}  // namespace limber
