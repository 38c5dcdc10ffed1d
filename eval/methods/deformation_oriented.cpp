// SPDX-License-Identifier: Apache-2.0
// Huang, Chen & Chuang 2006, "Progressive deforming meshes based on deformation oriented decimation and dynamic
// connectivity updating", section on the metric: the cost of `dsd`, and more where the surface deforms.
//
//   begin:  the deformation of every vertex: how far its neighbours are from moving rigidly, mean over the frames seen
//           contract as `dsd`, the quadrics of a vertex weighted by 1 + kWeight x its deformation / the mean of all
//   frame:  place the clusters anew (static_clusters.h)
//
// The paper's: the sum over frames of Mohr & Gleicher's cost has a term added that grows with the distortion which the
// deformation brings, so that areas of large deformation keep more of their detail. Our reading, made from what later
// papers say of it: the term is a weight on the quadrics, which stay sums of squares, and the deformation is measured
// by local_motion.h against the first frame. Its dynamic connectivity, vertex trees that depart a little from this
// clustering in each frame, is not made here: `best-cut` shows what such trees can give.
#include <algorithm>

#include "eval/methods/factories.h"
#include "eval/methods/local_motion.h"
#include "eval/methods/many_frames.h"
#include "eval/methods/static_method.h"

namespace limber::eval {
namespace {

// 1 gives the collapsing horse 1 % more RMS at 1,600 vertices than 0.5 does and the galloping one 2 % at 800, and 0,
// which is `dsd`, 1 and 3 % less: the metric is not after RMS.
constexpr double kWeight = 0.5;

// Where the mean deformation is less than this the surface moves all but rigidly, and what differs is mostly rounding.
constexpr double kLeastMean = 0.01;

// [mesh.vertex_count]
std::vector<double> deformation_weights(const Mesh& mesh, std::span<const std::span<const Vec3f>> seen) {
  LocalMotions local_motions(mesh, seen[0]);
  std::vector<LocalMotion> motions(mesh.vertex_count);
  std::vector<double> weights(mesh.vertex_count);
  double total = 0;
  for (const std::span<const Vec3f> positions : seen) {
    local_motions.fit(positions, motions);
    for (Index v = 0; v < mesh.vertex_count; ++v) {
      weights[v] += motions[v].deformation;
      total += motions[v].deformation;
    }
  }
  const auto frame_count = static_cast<double>(seen.size());
  const double mean = std::max(kLeastMean, total / (frame_count * std::max<Index>(1, mesh.vertex_count)));
  for (double& weight : weights) weight = 1 + kWeight * weight / (frame_count * mean);
  return weights;
}

Contractor contractor_by_deformation(const Mesh& mesh, std::span<const std::span<const Vec3f>> seen,
                                     const ContractOptions& options) {
  const std::vector<double> weights = deformation_weights(mesh, seen);
  const auto weigh = [&](std::size_t, std::span<Quadric> quadrics) {
    for (std::size_t v = 0; v < quadrics.size(); ++v) quadrics[v] *= weights[v];
  };
  return Contractor(mesh, seen, for_many_frames(options), {}, weigh);
}

}  // namespace

std::unique_ptr<Method> make_deformation_oriented(const MethodOptions& options) {
  return make_static_method(options, contractor_by_deformation);
}

}  // namespace limber::eval
