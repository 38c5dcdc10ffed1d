// SPDX-License-Identifier: Apache-2.0
#include "eval/methods/follower.h"

#include "eval/methods/thread_time.h"

namespace limber::eval {

Follower::Follower(const Mesh& mesh, Hierarchy base, const ReclusterOptions& recluster, const CutOptions& cut,
                   Index blend)
    : reclusterer_(mesh, std::move(base), recluster), cut_mesh_(mesh, reclusterer_.hierarchy(), cut, blend) {}

void Follower::frame(std::span<const Vec3f> positions, Approximation& out) {
  const ThreadTimer adapting;
  reclusterer_.step(positions);
  out.adapt_seconds = adapting.seconds();

  // In place of coding and decoding.
  state_.hierarchy = reclusterer_.hierarchy();
  state_.positions.assign(reclusterer_.positions().begin(), reclusterer_.positions().end());
  state_.errors.assign(reclusterer_.errors().begin(), reclusterer_.errors().end());
  cut_mesh_.frame(state_, out);
  ++state_.frame;
}

}  // namespace limber::eval
