// SPDX-License-Identifier: Apache-2.0
// How much of an approximation's connectivity is new in a frame.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "limber/base/mesh.h"

namespace limber::eval {

// Takes the triangles of an approximation frame by frame, as triples of node ids that mean the same in every frame.
class ChangedTriangles {
 public:
  // Gives the share, 0 to 1, of the triangles that were not present in the frame before; nothing for the first frame.
  // The order of the ids in a triangle, and of the triangles, does not matter. No triangles: nothing has changed.
  std::optional<double> add(std::span<const Triangle> ids);

 private:
  bool first_frame_ = true;
  std::vector<Triangle> before_;  // sorted, each triangle sorted
  std::vector<Triangle> now_;
};

}  // namespace limber::eval
