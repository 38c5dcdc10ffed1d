// SPDX-License-Identifier: Apache-2.0
#include "limber/fourface/frame_errors.h"

#include <algorithm>
#include <cassert>
#include <vector>

#include "limber/fourface/record.h"
#include "limber/fourface/vertex_errors.h"

namespace limber {
namespace {

Index corner_after(const Triangle& t, Index corner) { return t[0] == corner ? t[1] : t[1] == corner ? t[2] : t[0]; }

bool has_corner(const Triangle& t, Index corner) { return t[0] == corner || t[1] == corner || t[2] == corner; }

// (v, s, t) and (s, r, t) are left of the quad, in either order.
double swap_error(const FourKMesh& mesh, const VertexErrors& errors, Index o) {
  const Triangle *near = &mesh.triangles[mesh.created_begin[o]], *far = near + 1;
  const Index v = mesh.vertex[o];
  if (!has_corner(*near, v)) std::swap(near, far);
  const Index s = corner_after(*near, v), t = corner_after(*near, s);
  return errors.swap_error(v, corner_after(*far, s), s, t);
}

// The other end of the new edge; u itself where there is none.
Index opposite(const FourKMesh& mesh, Index o) {
  const auto destroyed = mesh.destroyed_by(o);
  const Triangle& left = mesh.triangles[mesh.created_begin[o]];
  if (destroyed.size() == 4) return left[2];
  if (destroyed.size() == 3) return left[0];
  // At a border, the corner that one of both triangles has.
  const bool both =
      has_corner(mesh.triangles[destroyed[0]], left[1]) && has_corner(mesh.triangles[destroyed[1]], left[1]);
  return both ? left[2] : left[1];
}

}  // namespace

void measure_frame(FourKMesh& mesh, std::span<const Vec3f> positions, const QuadricOptions& options) {
  assert(positions.size() == mesh.vertex_count);
  Mesh finest{mesh.vertex_count, {mesh.triangles.begin(), mesh.triangles.begin() + mesh.finest_count}};
  const Normalization normalize = normalization(positions);
  std::vector<Vec3d> unit(positions.size());
  std::transform(positions.begin(), positions.end(), unit.begin(),
                 [&](const Vec3f& p) { return normalize.to_unit(p); });
  VertexErrors errors(finest, std::move(unit), 1, options);
  for (Index o = 0; o < mesh.operation_count(); ++o) {
    const Index v = mesh.vertex[o];
    if (!mesh.is_removal(o)) {
      mesh.error[o] = static_cast<float>(swap_error(mesh, errors, o));
      continue;
    }
    const Index u = mesh.kept(o);
    mesh.error[o] = static_cast<float>(errors.removal_error(v, u));
    errors.share(v, u, opposite(mesh, o));
  }
  make_monotone(mesh, positions, normalize.scale);
}

}  // namespace limber
