// SPDX-License-Identifier: Apache-2.0
// What becomes of triangles when their vertices become others.
#pragma once

#include <span>
#include <vector>

#include "limber/base/mesh.h"

namespace limber {

// The images of triangles under image_of ([vertex_count]) that are not degenerate, in their order; out: overwritten.
inline void list_images(std::span<const Triangle> triangles, std::span<const Index> image_of,
                        std::vector<Triangle>& out) {
  out.clear();
  for (const auto& [a, b, c] : triangles) {
    const Triangle image{image_of[a], image_of[b], image_of[c]};
    if (!is_degenerate(image)) out.push_back(image);
  }
}

// Renames the corners, all less than vertex_count, to 0, 1, ... in the order in which they are first met. vertices:
// overwritten by what each of these was called before; number: scratch.
inline void renumber(std::span<Triangle> triangles, Index vertex_count, std::vector<Index>& vertices,
                     std::vector<Index>& number) {
  vertices.clear();
  number.assign(vertex_count, kNone);
  for (Triangle& triangle : triangles) {
    for (Index& corner : triangle) {
      Index& known = number[corner];
      if (known == kNone) {
        known = static_cast<Index>(vertices.size());
        vertices.push_back(corner);
      }
      corner = known;
    }
  }
}

}  // namespace limber
