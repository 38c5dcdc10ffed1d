// SPDX-License-Identifier: Apache-2.0
// Garland & Heckbert 1997, section 4; for many frames Mohr & Gleicher 2003. Differences: docs/design.md, "Contraction".
//
//   contract_to(target):
//     while vertex_count > target:
//       take the edge of least cost
//       if its ends have changed since it was priced:     cost() again, back into the queue
//       else if it would break the topology or fold over:  put off until its surroundings change
//       else:                                              apply()
//     with nothing left to take: give every edge put off another chance, then one without the fold-over check
//
// Prices are brought up to date only when an edge reaches the front: quadrics are sums of squares, so a cost in any
// frame only ever grows as its ends absorb others, and an old one is a lower bound. The order is the same as if all
// were kept up to date.
#include "limber/contract/contract.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "limber/base/triangles.h"
#include "limber/contract/volume_contractor.h"

namespace limber {

Contractor::Contractor(const Mesh& mesh, std::span<const std::span<const Vec3f>> frames, const ContractOptions& options,
                       GoOnFunction go_on, const ChangeQuadricsFunction& change_quadrics)
    : Contraction(std::move(go_on)), options_(options), frame_count_(frames.size()), minima_(frames.size()) {
  assert(!frames.empty() && options.placement == Placement::kQuadric);
  const Placed placed = adopt(mesh, frames[0]);
  if (is_cancelled()) return;
  VertexQuadrics vertex_quadrics(placed.mesh, placed.edges, options.quadrics);
  if (!goes_on(kStepsUnasked)) return;

  const std::size_t quadric_count = order_.size() * frame_count_;
  quadrics_.reserve(quadric_count);
  while (quadrics_.size() < quadric_count) {
    if (!goes_on(kStepsUnasked)) return;
    quadrics_.resize(std::min(quadric_count, quadrics_.size() + 65536));
  }
  positions_.resize(quadric_count);
  std::vector<Vec3d> unit(order_.size());
  const bool is_direct = frame_count_ == 1 && !change_quadrics;
  std::vector<Quadric> of_one_frame(is_direct ? 0 : order_.size()), changed(change_quadrics ? order_.size() : 0);
  for (std::size_t f = 0; f < frame_count_; ++f) {
    if (!goes_on(kStepsUnasked)) return;
    assert(frames[f].size() == order_.size());
    normalizations_.push_back(normalization(frames[f]));
    normalizations_[f].scale = normalizations_[0].scale;
    for (Index i = 0; i < order_.size(); ++i) {
      unit[i] = normalizations_[f].to_unit(frames[f][order_[i]]);
      positions_[i * frame_count_ + f] = static_cast<Vec3f>(unit[i]);
    }
    if (is_direct) {
      vertex_quadrics.compute(unit, quadrics_);
    } else {
      vertex_quadrics.compute(unit, of_one_frame);
      if (change_quadrics) {
        for (Index i = 0; i < order_.size(); ++i) changed[order_[i]] = of_one_frame[i];
        change_quadrics(f, changed);
        for (Index i = 0; i < order_.size(); ++i) of_one_frame[i] = changed[order_[i]];
      }
      for (Index i = 0; i < order_.size(); ++i) quadrics_[i * frame_count_ + f] = of_one_frame[i];
    }
  }
  start_queue([this](Index edge) { return cost(edge); });
}

float Contractor::cost(Index edge) const {
  const auto [u, v] = surface_.ends(edge);
  const bool is_sum = options_.frame_cost == FrameCost::kSum;
  double total = 0;
  for (std::size_t f = 0; f < frame_count_; ++f) {
    const double value = minimum(quadrics_[u * frame_count_ + f] + quadrics_[v * frame_count_ + f]).value;
    total = is_sum ? total + value : std::max(total, value);
  }
  return static_cast<float>(total);
}

// Whether moving both ends to minima_ turns a triangle that survives too far in any frame.
bool Contractor::folds_over(Index edge) {
  const auto ends = surface_.ends(edge);
  bool found = false;
  for (const Index end : ends) {
    const Index other = end == ends[0] ? ends[1] : ends[0];
    surface_.for_each_triangle(end, [&](Index t) {
      const Triangle& corners = surface_.triangle(t);
      const bool is_second = corners[1] == end, is_third = corners[2] == end;
      const Index b = corners[is_second ? 2 : !is_third], c = corners[is_second ? 0 : 2 - is_third];
      if (found | (b == other) | (c == other)) return;
      for (std::size_t f = 0; f < frame_count_ && !found; ++f) {
        const Vec3d& pb = static_cast<Vec3d>(positions_[b * frame_count_ + f]);
        const Vec3d opposite_edge = static_cast<Vec3d>(positions_[c * frame_count_ + f]) - pb;
        const Vec3d before = cross(opposite_edge, static_cast<Vec3d>(positions_[end * frame_count_ + f]) - pb);
        const Vec3d after = cross(opposite_edge, minima_[f] - pb);
        const double cosine = dot(before, after);
        const double limit = options_.fold_over_cosine;
        const double lengths = squared_length(before) * squared_length(after);
        found = limit >= 0 ? cosine < 0 || cosine * cosine < limit * limit * lengths
                           : cosine < 0 && cosine * cosine > limit * limit * lengths;
      }
    });
  }
  return found;
}

void Contractor::apply(Index edge) {
  const auto [u, v] = surface_.ends(edge);
  for (std::size_t f = 0; f < frame_count_; ++f) {
    quadrics_[u * frame_count_ + f] += quadrics_[v * frame_count_ + f];
    positions_[u * frame_count_ + f] = static_cast<Vec3f>(minima_[f]);
  }
  merged_into_[v] = u;
  for (const Index gone : surface_.contract(edge)) state_[gone] = EdgeState::kGone;
  surface_.for_each_edge(u, [&](Index e, Index) {
    if (state_[e] == EdgeState::kPutOff)
      enqueue(e, cost(e));
    else
      state_[e] = EdgeState::kStale;
  });
}

// What the next contractions will touch is on its way while this one is made.
void Contractor::fetch_ahead() const {
  const auto next = [this](std::size_t ahead, auto&& ask) {
    const Index e = queue_.upcoming(ahead);
    if (e != kNone && state_[e] == EdgeState::kPriced) ask(e);
  };
  next(9, [this](Index e) { surface_.fetch_edge(e); });
  next(7, [this](Index e) { surface_.fetch_ends(e, [this](Index v) { fetch_quadric(v); }); });
  next(5, [this](Index e) { surface_.fetch_runs(e); });
  next(3, [this](Index e) { surface_.fetch_records(e); });
  next(1, [this](Index e) { surface_.fetch_neighbours(e, [this](Index v) { fetch(&positions_[v * frame_count_]); }); });
}

Index Contractor::contract_to(Index target) {
  const auto fetch_edge = [this](Index edge) {
    if (state_[edge] == EdgeState::kStale) surface_.fetch_edge(edge);
  };
  const auto fetch_ends = [this](Index edge) {
    if (state_[edge] == EdgeState::kStale) surface_.fetch_ends(edge, [this](Index v) { fetch_quadric(v); });
  };
  const auto attempt = [this](Index edge) {
    const auto [u, v] = surface_.ends(edge);
    for (std::size_t f = 0; f < frame_count_; ++f)
      minima_[f] = minimum(quadrics_[u * frame_count_ + f] + quadrics_[v * frame_count_ + f]).point;
    if ((options_.topology == Topology::kPreserve && !surface_.keeps_topology(edge)) ||
        (check_fold_over_ && folds_over(edge)))
      return false;
    apply(edge);
    return true;
  };
  return contract_cheapest(
      target, [this](Index edge) { return cost(edge); }, fetch_edge, fetch_ends, [this] { fetch_ahead(); }, attempt);
}

Vec3f Contractor::position(Index representative, std::size_t frame) const {
  const Index place = places_[representative];
  assert(merged_into_[place] == kNone && frame < frame_count_);
  return normalizations_[frame].from_unit(static_cast<Vec3d>(positions_[place * frame_count_ + frame]));
}

std::unique_ptr<Contraction> start_contraction(const Mesh& mesh, std::span<const Vec3f> positions,
                                               const ContractOptions& options, GoOnFunction go_on) {
  if (options.placement == Placement::kVolume)
    return std::make_unique<VolumeContractor>(mesh, positions, options, std::move(go_on));
  return std::make_unique<Contractor>(mesh, std::span(&positions, 1), options, std::move(go_on));
}

Simplified simplified_mesh(const Contraction& contraction, const Mesh& mesh, std::size_t frame) {
  Simplified out;
  std::vector<Index> representative(mesh.vertex_count), number;
  for (Index v = 0; v < mesh.vertex_count; ++v) representative[v] = contraction.representative(v);
  list_images(mesh.triangles, representative, out.mesh.triangles);
  renumber(out.mesh.triangles, mesh.vertex_count, out.vertices, number);
  for (const Index v : out.vertices) out.positions.push_back(contraction.position(v, frame));
  out.mesh.vertex_count = static_cast<Index>(out.vertices.size());
  return out;
}

Simplified simplify(const Mesh& mesh, std::span<const Vec3f> positions, Index vertex_count,
                    const ContractOptions& options) {
  const auto contraction = start_contraction(mesh, positions, options);
  contraction->contract_to(vertex_count);
  return simplified_mesh(*contraction, mesh, 0);
}

}  // namespace limber
