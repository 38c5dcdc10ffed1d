// SPDX-License-Identifier: Apache-2.0
// The clusters of the first frame for the whole clip: what Mohr & Gleicher 2003 call the naive approach, with the
// optimal position of every cluster in every frame.
//
//   begin:  contract the first frame; its clusters and triangles stay
//   frame:  place the clusters anew (static_clusters.h)
#include "eval/methods/factories.h"
#include "eval/methods/static_method.h"

namespace limber::eval {
namespace {

Contractor contractor_of_first_frame(const Mesh& mesh, std::span<const std::span<const Vec3f>> seen,
                                     const ContractOptions& options) {
  return Contractor(mesh, seen.first(1), options);
}

}  // namespace

std::unique_ptr<Method> make_first_frame(const MethodOptions& options) {
  return make_static_method(options, contractor_of_first_frame);
}

}  // namespace limber::eval
