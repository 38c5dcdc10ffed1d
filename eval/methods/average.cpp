// SPDX-License-Identifier: Apache-2.0
// Kircher & Garland 2005, section 6: the "average" mesh that they compare with (their Fig. 11).
//
//   begin:  contract under the largest cost of an edge in any of the frames seen
//   frame:  place the clusters anew (static_clusters.h)
//
// The paper looks only at the edges that are the cheapest in some frame, and takes that among them whose largest cost
// is smallest. Here every edge is looked at, so that the largest cost of the one taken is never above the paper's, and
// one queue serves all frames. Frames seen are those of `dsd`.
#include "eval/methods/factories.h"
#include "eval/methods/many_frames.h"
#include "eval/methods/static_method.h"

namespace limber::eval {
namespace {

Contractor contractor_by_largest(const Mesh& mesh, std::span<const std::span<const Vec3f>> seen,
                                 const ContractOptions& options) {
  ContractOptions by_largest = for_many_frames(options);
  by_largest.frame_cost = FrameCost::kLargest;
  return Contractor(mesh, seen, by_largest);
}

}  // namespace

std::unique_ptr<Method> make_average(const MethodOptions& options) {
  return make_static_method(options, contractor_by_largest);
}

}  // namespace limber::eval
