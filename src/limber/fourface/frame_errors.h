// SPDX-License-Identifier: Apache-2.0
// The errors of a 4-K mesh in another pose than it was built for.
#pragma once

#include <span>

#include "limber/base/vec.h"
#include "limber/contract/vertex_quadrics.h"
#include "limber/fourface/four_k_mesh.h"

namespace limber {

// Sets errors and radii to those of a frame: the operations are gone through once more, with the quadrics and distances
// of these positions. positions: [mesh.vertex_count], finite. Time and memory in proportion to the mesh.
void measure_frame(FourKMesh& mesh, std::span<const Vec3f> positions, const QuadricOptions& options = {});

}  // namespace limber
