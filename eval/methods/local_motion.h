// SPDX-License-Identifier: Apache-2.0
// How the surroundings of each vertex have moved since a rest pose: a rotation, and what no rotation explains.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "limber/base/mesh.h"
#include "limber/base/vec.h"

namespace limber::eval {

struct LocalMotion {
  // What becomes of the axes x, y and z of the rest pose: the rotation that brings the edges around the vertex nearest
  // to where they are, by the sum of squared distances. The axes themselves where there is no edge.
  std::array<Vec3d, 3> axes{Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}};
  // The root of that sum over the sum of the squared edge lengths of the rest pose, >= 0; 0 for a rigid motion.
  double deformation = 0;
};

class LocalMotions {
 public:
  // rest: [mesh.vertex_count]. Neither need live on.
  LocalMotions(const Mesh& mesh, std::span<const Vec3f> rest);

  // motions: [vertex_count], overwritten.
  void fit(std::span<const Vec3f> positions, std::span<LocalMotion> motions);

 private:
  // Of the edges around a vertex: outer products of rest and moved edge, by rows; squared lengths of both.
  struct Sums {
    std::array<Vec3d, 3> products{};
    double rest = 0, moved = 0;
  };

  std::vector<std::array<Index, 2>> edges_;
  std::vector<Vec3d> rest_edges_;  // [edges_.size()]
  std::vector<Sums> sums_;         // [vertex_count], scratch
};

}  // namespace limber::eval
