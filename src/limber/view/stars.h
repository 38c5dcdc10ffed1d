// SPDX-License-Identifier: Apache-2.0
// The triangles around every vertex of a mesh.
// Part of the player: standard library only.
#pragma once

#include <span>
#include <vector>

#include "limber/base/mesh.h"

namespace limber {

class Stars {
 public:
  explicit Stars(const Mesh& mesh);

  // Numbers of the triangles that have the vertex as a corner and are not degenerate, in rising order.
  std::span<const Index> of(Index vertex) const {
    return std::span(faces_).subspan(begin_[vertex], begin_[vertex + 1] - begin_[vertex]);
  }

 private:
  std::vector<Index> begin_, faces_;
};

}  // namespace limber
