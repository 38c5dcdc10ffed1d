// SPDX-License-Identifier: Apache-2.0
// The mesh of a sheet.
#pragma once

#include "limber/base/mesh.h"

namespace limber::test {

// columns x rows vertices, numbered row by row, and two triangles per square, square by square.
inline Mesh grid(Index columns, Index rows) {
  Mesh mesh;
  mesh.vertex_count = columns * rows;
  for (Index y = 0; y + 1 < rows; ++y) {
    for (Index x = 0; x + 1 < columns; ++x) {
      const Index a = y * columns + x, b = a + 1, c = a + columns, d = c + 1;
      mesh.triangles.push_back({a, b, d});
      mesh.triangles.push_back({a, d, c});
    }
  }
  return mesh;
}

}  // namespace limber::test
