// SPDX-License-Identifier: Apache-2.0
#include "limber/fourface/front.h"

#include <cassert>

namespace limber {

Front::Front(const FourKMesh& mesh)
    : mesh_(&mesh),
      place_(mesh.triangle_count(), kNone),
      candidate_place_(mesh.operation_count(), kNone),
      applied_(mesh.operation_count(), 1),
      remembered_(applied_) {
  for (Index t = 0; t < mesh.triangle_count(); ++t)
    if (mesh.destroyer[t] == kNone) add(t);
  std::vector<bool> used(mesh.vertex_count, false);
  for (const Index t : alive_) {
    for (const Index corner : mesh.triangles[t]) {
      if (!used[corner]) ++vertex_count_;
      used[corner] = true;
    }
  }
  for (Index o = 0; o < mesh.operation_count(); ++o) update(o);
}

void Front::list(std::vector<Triangle>& corners) const {
  corners.resize(alive_.size());
  for (std::size_t i = 0; i < alive_.size(); ++i) corners[i] = mesh_->triangles[alive_[i]];
}

void Front::apply(Index operation) {
  assert(can_apply(operation));
  for (const Index t : mesh_->destroyed_by(operation)) remove(t);
  for (Index t = mesh_->created_begin[operation]; t < mesh_->created_begin[operation + 1]; ++t) add(t);
  applied_[operation] = 1;
  update_around(operation);
  if (mesh_->is_removal(operation)) --vertex_count_;
  ++changes_;
}

void Front::reverse(Index operation) {
  assert(can_reverse(operation));
  for (Index t = mesh_->created_begin[operation]; t < mesh_->created_begin[operation + 1]; ++t) remove(t);
  for (const Index t : mesh_->destroyed_by(operation)) add(t);
  applied_[operation] = 0;
  update_around(operation);
  if (mesh_->is_removal(operation)) ++vertex_count_;
  ++changes_;
}

void Front::update(Index operation) {
  Index& place = candidate_place_[operation];
  const bool is_candidate = is_applied(operation) ? can_reverse(operation) : can_apply(operation);
  if (is_candidate == (place != kNone)) return;
  if (is_candidate) {
    place = static_cast<Index>(candidates_.size());
    candidates_.push_back(operation);
    return;
  }
  const Index last = candidates_.back();
  candidates_[place] = last;
  candidate_place_[last] = place;
  candidates_.pop_back();
  place = kNone;
}

// The operation itself, which has been applied or reversed, and those that share its triangles.
void Front::update_around(Index operation) {
  update(operation);
  for (const Index t : mesh_->destroyed_by(operation))
    if (mesh_->creator[t] != kNone) update(mesh_->creator[t]);
  for (Index t = mesh_->created_begin[operation]; t < mesh_->created_begin[operation + 1]; ++t)
    if (mesh_->destroyer[t] != kNone) update(mesh_->destroyer[t]);
}

void Front::add(Index triangle) {
  place_[triangle] = static_cast<Index>(alive_.size());
  alive_.push_back(triangle);
}

void Front::remove(Index triangle) {
  const Index place = place_[triangle], last = alive_.back();
  alive_[place] = last;
  place_[last] = place;
  alive_.pop_back();
  place_[triangle] = kNone;
}

}  // namespace limber
