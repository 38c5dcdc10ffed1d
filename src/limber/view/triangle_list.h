// SPDX-License-Identifier: Apache-2.0
// The triangles of a cut, as node ids.
// Part of the player: standard library only.
#pragma once

#include <vector>

#include "limber/base/mesh.h"
#include "limber/view/cut.h"

namespace limber {

// The caller's object, used again for each frame.
struct TriangleList {
  std::vector<Triangle> triangles;  // corners are active nodes, oriented as the finest triangle is
  std::vector<Index> faces;         // [triangles.size()]: the first finest triangle that each one is the image of

  std::vector<Index> living, slots;  // scratch of list_triangles()
};

// Lists the images of the finest triangles under the cut's labels, in the order of the finest triangles. An image with
// a corner twice is dropped. Of equal oriented images, whatever corner they start at, the first is kept; but where
// all three corners are finest vertices the input's own repetitions survive. Two images that differ only in their
// orientation are both kept (a flat fold seen from either side).
// Allocates only where the list has not been as long before.
// Precondition: cut.update() has been called, with this mesh.
void list_triangles(const Mesh& mesh, const Cut& cut, TriangleList& list);

}  // namespace limber
