// SPDX-License-Identifier: Apache-2.0
#include "limber/fourface/vertex_errors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace limber {

VertexErrors::VertexErrors(const Mesh& mesh, std::vector<Vec3d> positions, const QuadricOptions& options)
    : options_(options), positions_(std::move(positions)), quadrics_(mesh.vertex_count), own_error_(mesh.vertex_count) {
  VertexQuadrics(mesh, options_).compute(positions_, quadrics_);
  for (Index v = 0; v < mesh.vertex_count; ++v) own_error_[v] = quadrics_[v](positions_[v]);
}

void VertexErrors::hold_line(const FaceTable& faces, Index half_edge) {
  for (const Index h : {half_edge, faces.twin(half_edge)}) {
    const Vec3d from = positions_[faces.origin(h)], along = positions_[faces.target(h)] - from;
    const Vec3d across = cross(along, cross(along, positions_[faces.origin(FaceTable::previous(h))] - from));
    const double size = length(across);
    if (!(size > 0)) continue;
    const double weight = 0.5 * options_.border_weight * squared_length(along);
    const Quadric plane = Quadric::plane(across * (1 / size), from, weight);
    add(faces.origin(h), plane), add(faces.target(h), plane);
  }
}

double VertexErrors::least_removal(const FaceTable& faces, Index v) const {
  double least = std::numeric_limits<double>::infinity();
  const Index start = faces.outgoing(v);
  if (start == kNone) return least;
  const Quadric& own = quadrics_[v];
  const auto look_at = [&](Index u) { least = std::min(least, own(positions_[u]) + own_error_[u]); };
  Index h = start;
  do {
    look_at(faces.target(h));
    const Index back = FaceTable::previous(h);
    h = faces.twin(back);
    if (h == kNone) look_at(faces.origin(back));
  } while (h != start && h != kNone);
  if (h == kNone) {
    for (h = faces.twin(start); h != kNone; h = faces.twin(h)) {
      h = FaceTable::next(h);
      look_at(faces.target(h));
    }
  }
  return std::max(least, 0.0);
}

double VertexErrors::swap_error(Index v, Index r, Index s, Index t) const {
  const Vec3d across = cross(positions_[r] - positions_[v], positions_[t] - positions_[s]);
  const double size = length(across);
  return size > 0 ? std::fabs(dot(positions_[s] - positions_[v], across)) / size : 0;
}

double VertexErrors::removal_error(Index v, Index u) const {
  const Quadric& q = quadrics_[v];
  const double weight = q.trace();
  return weight > 0 ? std::sqrt(std::max(q(positions_[u]), 0.0) / weight) : 0;
}

void VertexErrors::add(Index v, const Quadric& quadric) {
  quadrics_[v] += quadric;
  own_error_[v] = quadrics_[v](positions_[v]);
}

void VertexErrors::share(Index v, Index u, Index w) {
  const Quadric& qv = quadrics_[v];
  if (u == w) return add(u, qv);
  const double cu = std::max(qv(positions_[u]) + own_error_[u], 0.0);
  const double cw = std::max(qv(positions_[w]) + own_error_[w], 0.0);
  const double share = cu + cw > 0 ? 1 - cu / (cu + cw) : 0.5;
  Quadric to_u = qv, to_w = qv;
  to_u *= share, to_w *= 1 - share;
  add(u, to_u), add(w, to_w);
}

}  // namespace limber
