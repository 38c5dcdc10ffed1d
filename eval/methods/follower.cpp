// SPDX-License-Identifier: Apache-2.0
#include "eval/methods/follower.h"

#include "eval/methods/thread_time.h"

namespace limber::eval {

Follower::Follower(const Mesh& mesh, Hierarchy base, const ReclusterOptions& recluster, const CutOptions& cut)
    : mesh_(mesh), reclusterer_(mesh, std::move(base), recluster), cut_(mesh, reclusterer_.hierarchy(), cut) {}

void Follower::frame(std::span<const Vec3f> positions, Approximation& out) {
  const ThreadTimer adapting;
  reclusterer_.step(positions);
  out.adapt_seconds = adapting.seconds();

  // In place of coding and decoding.
  state_.hierarchy = reclusterer_.hierarchy();
  state_.positions.assign(reclusterer_.positions().begin(), reclusterer_.positions().end());
  state_.errors.assign(reclusterer_.errors().begin(), reclusterer_.errors().end());

  const ThreadTimer extracting;
  cut_.update(mesh_, state_);
  extract(mesh_, state_, cut_, scratch_, buffers_);
  out.extract_seconds = extracting.seconds();

  out.positions = buffers_.positions;
  out.nodes = buffers_.nodes;
  out.triangles.resize(buffers_.triangle_count());
  for (std::size_t t = 0; t < out.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) out.triangles[t][k] = buffers_.indices[3 * t + k];
  }
  out.clusters.assign(cut_.labels().begin(), cut_.labels().begin() + mesh_.vertex_count);
}

}  // namespace limber::eval
