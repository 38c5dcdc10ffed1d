// SPDX-License-Identifier: Apache-2.0
// The triangles of a cut, or of a blend (blend.h), as node ids.
// Part of the player: standard library only.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "limber/base/mesh.h"

namespace limber {

// The caller's object, used again for each frame.
struct TriangleList {
  std::vector<Triangle> triangles;  // corners are labels, oriented as the finest triangle is
  std::vector<Index> faces;         // [triangles.size()]: the first finest triangle that each one is the image of

  std::vector<Index> living, slots;  // scratch of list_triangles()
};

// Lists the images of the finest triangles under the labels ([mesh.vertex_count] or longer; those of a Cut or a Blend),
// in the order of the finest triangles. An image with a corner twice is dropped. Of equal oriented images, whatever
// corner they start at, the first is kept; but where all three corners are finest vertices the input's own
// repetitions survive. Two images that differ only in their orientation are both kept (a flat fold seen from
// either side). Allocates only where the list has not been as long before.
void list_triangles(const Mesh& mesh, std::span<const Index> labels, TriangleList& list);

// The same of those finest triangles alone that have one of the vertices (not 0 in `vertices`, [mesh.vertex_count]) as
// a corner.
void list_triangles_around(const Mesh& mesh, std::span<const Index> labels, std::span<const std::uint8_t> vertices,
                           TriangleList& list);

}  // namespace limber
