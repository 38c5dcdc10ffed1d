// SPDX-License-Identifier: Apache-2.0
// A closed triangulation of an implicit surface, with exactly as many vertices as asked for.
#pragma once

#include <vector>

#include "limber/base/mesh.h"
#include "limber/clip/sample_body.h"

namespace limber {

struct SurfaceMesh {
  Mesh mesh;
  std::vector<Vec3d> positions;  // [mesh.vertex_count]
};

// Marching tetrahedra on a grid of the given spacing: closed, manifold, outward. Doi & Koide, "An efficient method of
// triangulating equi-valued surfaces by using tetrahedral cells", 1991. Features thinner than the spacing may be lost.
SurfaceMesh extract_surface(const BodySurface& surface, double spacing);

// Isotropic remeshing (Botsch & Kobbelt, "A remeshing approach to multiresolution modeling", 2004) with edge lengths in
// proportion to the body's sizes, then single splits and collapses to the exact count. The topology stays.
// Precondition: `start` is closed and manifold; vertex_count is at least about 60.
SurfaceMesh remesh(const BodySurface& surface, const SurfaceMesh& start, Index vertex_count);

}  // namespace limber
