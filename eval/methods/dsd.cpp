// SPDX-License-Identifier: Apache-2.0
// Mohr & Gleicher 2003, "Deformation sensitive decimation" (DSD): one sequence of contractions for all frames at once.
//
//   begin:  contract under the cost of an edge summed over the frames seen, each frame with a minimum of its own
//   frame:  place the clusters anew (static_clusters.h)
//
// The paper's poses are the frames seen: all of the clip where memory allows, otherwise as many as it holds, spread
// evenly (seen_frames.h). Frames in between are placed by their own quadrics all the same.
#include "eval/methods/factories.h"
#include "eval/methods/many_frames.h"
#include "eval/methods/static_method.h"

namespace limber::eval {
namespace {

Contractor contractor_by_sum(const Mesh& mesh, std::span<const std::span<const Vec3f>> seen,
                             const ContractOptions& options) {
  return Contractor(mesh, seen, for_many_frames(options));
}

}  // namespace

std::unique_ptr<Method> make_dsd(const MethodOptions& options) {
  return make_static_method(options, contractor_by_sum);
}

}  // namespace limber::eval
