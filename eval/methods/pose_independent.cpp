// SPDX-License-Identifier: Apache-2.0
// DeCoro & Rusinkiewicz 2005, "Pose-independent simplification of articulated meshes": one contraction in the rest
// pose, under quadrics that hold the planes of all poses.
//
//   begin:  for every frame seen and every vertex:
//             the quadric of the vertex in that frame, brought back to the rest pose by what the vertex does there
//           contract the rest pose under the mean of these quadrics
//   frame:  place the clusters anew (static_clusters.h)
//
// The paper's: quadrics are averaged over a distribution of poses by sampling it; each pose's quadric is brought to the
// rest pose by the transformation that the skin's weights blend for its vertex; from then on all is as for a static
// mesh. Our reading, for clips that come without a skeleton: the first frame is the rest pose, the frames seen are the
// samples, all equally likely, and a vertex does what the rotation does that fits its neighbours best (local_motion.h).
// The paper moves a contracted vertex by blended weights; here, where there are none, its clusters are placed as those
// of the other methods are.
#include <algorithm>

#include "eval/methods/factories.h"
#include "eval/methods/local_motion.h"
#include "eval/methods/static_method.h"
#include "limber/contract/vertex_quadrics.h"

namespace limber::eval {
namespace {

// `q` around another origin: the result at x - origin is q at x.
Quadric around(const Quadric& q, const Vec3d& origin) {
  const Vec3d a{q.xx * origin.x + q.xy * origin.y + q.xz * origin.z,
                q.xy * origin.x + q.yy * origin.y + q.yz * origin.z,
                q.xz * origin.x + q.yz * origin.y + q.zz * origin.z};
  Quadric moved = q;
  moved.bx += a.x, moved.by += a.y, moved.bz += a.z;
  moved.c = q(origin);
  return moved;
}

// `q` before a rotation about the origin: the result at x is q where the rotation takes x.
Quadric before_turn(const Quadric& q, const std::array<Vec3d, 3>& axes) {
  const auto times = [&q](const Vec3d& v) {
    return Vec3d{q.xx * v.x + q.xy * v.y + q.xz * v.z, q.xy * v.x + q.yy * v.y + q.yz * v.z,
                 q.xz * v.x + q.yz * v.y + q.zz * v.z};
  };
  const Vec3d ax = times(axes[0]), ay = times(axes[1]), az = times(axes[2]), b{q.bx, q.by, q.bz};
  return {dot(axes[0], ax), dot(axes[0], ay), dot(axes[0], az), dot(axes[1], ay), dot(axes[1], az),
          dot(axes[2], az), dot(axes[0], b),  dot(axes[1], b),  dot(axes[2], b),  q.c};
}

// [mesh.vertex_count], normalized as the first frame.
std::vector<Quadric> mean_quadrics(const Mesh& mesh, std::span<const std::span<const Vec3f>> seen,
                                   const QuadricOptions& options) {
  const Normalization at_rest = normalization(seen[0]);
  VertexQuadrics vertex_quadrics(mesh, options);
  LocalMotions local_motions(mesh, seen[0]);
  std::vector<LocalMotion> motions(mesh.vertex_count);
  std::vector<Vec3d> unit(mesh.vertex_count);
  std::vector<Quadric> quadrics(mesh.vertex_count), mean(mesh.vertex_count);
  for (const std::span<const Vec3f> positions : seen) {
    const Normalization normalize{normalization(positions).center, at_rest.scale};
    for (Index v = 0; v < mesh.vertex_count; ++v) unit[v] = normalize.to_unit(positions[v]);
    vertex_quadrics.compute(unit, quadrics);
    local_motions.fit(positions, motions);
    for (Index v = 0; v < mesh.vertex_count; ++v) {
      Quadric back = before_turn(around(quadrics[v], unit[v]), motions[v].axes);
      back *= 1 / static_cast<double>(seen.size());
      mean[v] += around(back, -at_rest.to_unit(seen[0][v]));
    }
  }
  return mean;
}

Contractor contractor_of_all_poses(const Mesh& mesh, std::span<const std::span<const Vec3f>> seen,
                                   const ContractOptions& options) {
  const auto replace = [&](std::size_t, std::span<Quadric> quadrics) {
    const std::vector<Quadric> mean = mean_quadrics(mesh, seen, options.quadrics);
    std::ranges::copy(mean, quadrics.begin());
  };
  return Contractor(mesh, seen.first(1), options, {}, replace);
}

}  // namespace

std::unique_ptr<Method> make_pose_independent(const MethodOptions& options) {
  return make_static_method(options, contractor_of_all_poses);
}

}  // namespace limber::eval
