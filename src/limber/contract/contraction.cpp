// SPDX-License-Identifier: Apache-2.0
#include "limber/contract/contraction.h"

#include <utility>

namespace limber {

Contraction::Placed Contraction::adopt(const Mesh& mesh, std::span<const Vec3f> positions) {
  SpatialMesh spatial = in_spatial_order(mesh, positions);
  order_ = std::move(spatial.order);
  places_ = std::move(spatial.places);
  if (!goes_on(kStepsUnasked)) return {};
  Placed placed{std::move(spatial.mesh), {}};
  placed.edges = find_edges(placed.mesh);
  if (!goes_on(kStepsUnasked)) return {};
  surface_ = Surface(placed.mesh, placed.edges);
  merged_into_.resize(order_.size(), kNone);
  return placed;
}

Index Contraction::representative(Index v) const {
  Index place = places_[v];
  while (merged_into_[place] != kNone) place = merged_into_[place];
  return order_[place];
}

void Contraction::shorten_chains() {
  for (Index v = 0; v < merged_into_.size(); ++v) {
    Index root = v;
    while (merged_into_[root] != kNone) root = merged_into_[root];
    for (Index at = v; at != root;) at = std::exchange(merged_into_[at], root);
  }
}

}  // namespace limber
