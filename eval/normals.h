// SPDX-License-Identifier: Apache-2.0
// Normals of vertices for smooth shading.
#pragma once

#include <span>
#include <vector>

#include "limber/base/mesh.h"
#include "limber/base/vec.h"

namespace limber::eval {

// Unit normals, [positions]; zero where no triangle gives a direction. Weights of Max, Weights for Computing Vertex
// Normals from Facet Normals, 1999: exact for vertices on a sphere.
std::vector<Vec3f> vertex_normals(std::span<const Triangle> triangles, std::span<const Vec3f> positions);

}  // namespace limber::eval
