// SPDX-License-Identifier: Apache-2.0
// What a half-edge structure can hold.
#pragma once

#include "limber/base/mesh.h"
#include "limber/base/result.h"

namespace limber::eval {

// Nothing where every edge lies on one triangle or on two that run through it in opposite directions, and the triangles
// around every vertex form one fan, open or closed. Otherwise an error kBadInput that names the first place where that
// is not so: degenerate triangles before edges before vertices.
Result<void> check_oriented_manifold(const Mesh& mesh);

}  // namespace limber::eval
