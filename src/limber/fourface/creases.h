// SPDX-License-Identifier: Apache-2.0
// Edges that a simplification may be told to keep as lines.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "limber/base/mesh.h"
#include "limber/base/vec.h"

namespace limber {

// The edges of two triangles whose normals have an angle with less than this cosine, -1 to 1.
std::vector<std::array<Index, 2>> find_creases(const Mesh& mesh, std::span<const Vec3f> positions, double cosine);

}  // namespace limber
