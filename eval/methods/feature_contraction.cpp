// SPDX-License-Identifier: Apache-2.0
// Zhang & Wu 2007, sections 3.1 and 3.2.
//
//   contract_to(size):
//     while larger:
//       take the edge of least cost
//       if it would break the topology or fold over: put off until its surroundings change
//       else: contract it; measure() the edges of the vertex that stays; new prices for them and, because of the
//             factor, for the edges of its neighbours
//     with nothing left to take: give every edge put off another chance, then one without the fold-over check
#include "eval/methods/feature_contraction.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace limber::eval {
namespace {

// A contraction may fold over in one of so many frames: where a single one can refuse, a clip that crumples leaves
// little to choose from.
constexpr std::size_t kFramesPerFold = 10;

}  // namespace

FeatureContraction::FeatureContraction(Surface surface, FrameData data, const ContractOptions& options, double k1,
                                       EdgeFactor& factor)
    : surface_(std::move(surface)),
      data_(std::move(data)),
      options_(options),
      k1_(k1),
      factor_(factor),
      sums_(surface_.edge_count()),
      deviations_(surface_.edge_count()),
      prices_(surface_.edge_count(), -1),
      versions_(surface_.edge_count(), 0),
      state_(surface_.edge_count(), EdgeState::kQueued),
      costs_(data_.frame_count),
      minima_(data_.frame_count) {
  assert(data_.frame_count > 0 && data_.quadrics.size() == data_.positions.size());
  Index corner_count = 0;
  for (Index v = 0; v < data_.positions.size() / data_.frame_count; ++v)
    surface_.for_each_triangle(v, [&](Index) { ++corner_count; });
  triangle_count_ = corner_count / 3;
  for (Index e = 0; e < surface_.edge_count(); ++e) {
    measure(e);
    enqueue(e);
  }
}

void FeatureContraction::measure(Index edge) {
  const auto [u, v] = surface_.ends(edge);
  const std::size_t frame_count = data_.frame_count;
  double sum = 0, deviation = 0;
  for (std::size_t f = 0; f < frame_count; ++f)
    sum += costs_[f] = minimum(data_.quadrics[u * frame_count + f] + data_.quadrics[v * frame_count + f]).value;
  const double mean = sum / static_cast<double>(frame_count);
  for (const double cost : costs_) deviation += std::abs(cost - mean);
  sums_[edge] = sum;
  deviations_[edge] = deviation;
}

void FeatureContraction::enqueue(Index edge) {
  const double price = factor_.factor(surface_, data_.positions, edge) * sums_[edge] + k1_ * deviations_[edge];
  if (price == prices_[edge] && state_[edge] == EdgeState::kQueued) return;
  // A higher price is for when the edge comes to the front.
  const bool is_late = state_[edge] == EdgeState::kQueued && price > prices_[edge] && prices_[edge] >= 0;
  prices_[edge] = price;
  if (is_late) return;
  state_[edge] = EdgeState::kQueued;
  heap_.push_back({price, edge, ++versions_[edge]});
  std::push_heap(heap_.begin(), heap_.end());
}

Index FeatureContraction::take() {
  while (!heap_.empty()) {
    std::pop_heap(heap_.begin(), heap_.end());
    Entry& entry = heap_.back();
    const bool is_valid = surface_.is_alive(entry.edge) && versions_[entry.edge] == entry.version;
    if (is_valid && entry.price < prices_[entry.edge]) {
      entry.price = prices_[entry.edge];
      std::push_heap(heap_.begin(), heap_.end());
      continue;
    }
    const Index edge = entry.edge;
    heap_.pop_back();
    if (is_valid) return edge;
  }
  return kNone;
}

// Whether moving both ends to minima_ turns a triangle that survives too far in too many frames.
bool FeatureContraction::folds_over(Index edge) {
  const auto ends = surface_.ends(edge);
  const std::size_t frame_count = data_.frame_count;
  const double limit = options_.fold_over_cosine;
  std::size_t folded = 0;
  const std::size_t most = frame_count / kFramesPerFold;
  for (std::size_t f = 0; f < frame_count && folded <= most; ++f) {
    bool found = false;
    for (const Index end : ends) {
      const Index other = ends[0] ^ ends[1] ^ end;
      surface_.for_each_triangle(end, [&](Index t) {
        const Triangle& corners = surface_.triangle(t);
        const std::size_t at = corners[0] == end ? 0 : corners[1] == end ? 1 : 2;
        const Index b = corners[(at + 1) % 3], c = corners[(at + 2) % 3];
        if (found || b == other || c == other) return;
        const Vec3d pb = static_cast<Vec3d>(position(b, f));
        const Vec3d opposite = static_cast<Vec3d>(position(c, f)) - pb;
        const Vec3d before = cross(opposite, static_cast<Vec3d>(position(end, f)) - pb);
        const Vec3d after = cross(opposite, minima_[f] - pb);
        found = dot(before, after) < limit * std::sqrt(squared_length(before) * squared_length(after));
      });
    }
    folded += found;
  }
  return folded > most;
}

void FeatureContraction::apply(Index edge) {
  const auto [u, v] = surface_.ends(edge);
  const std::size_t frame_count = data_.frame_count;
  for (std::size_t f = 0; f < frame_count; ++f) {
    data_.quadrics[u * frame_count + f] += data_.quadrics[v * frame_count + f];
    data_.positions[u * frame_count + f] = static_cast<Vec3f>(minima_[f]);
  }
  triangle_count_ -= surface_.triangle_count(edge);
  surface_.contract(edge);
  merges_.push_back({u, v});
  factor_.contracted(u, v);
  neighbours_.clear();
  around_.clear();
  surface_.for_each_edge(u, [&](Index e, Index w) {
    measure(e);
    neighbours_.push_back(w);
    around_.push_back(e);
  });
  if (factor_.is_of_ends()) neighbours_.clear();
  // Not while the surface is being visited: the factor visits it too.
  for (const Index w : neighbours_) {
    surface_.for_each_edge(w, [&, u = u](Index e, Index other) {
      if (other != u && state_[e] == EdgeState::kQueued) around_.push_back(e);
    });
  }
  for (const Index e : around_) enqueue(e);
}

void FeatureContraction::contract_to(Index vertices, Index triangles) {
  assert((vertices > 0) != (triangles > 0));
  const auto is_small = [&] {
    return vertices > 0 ? surface_.vertex_count() <= vertices : triangle_count_ <= triangles;
  };
  bool progress = true;
  while (!is_small()) {
    Index edge = take();
    if (edge == kNone) {
      if (!progress && !check_fold_over_) break;
      check_fold_over_ = progress && check_fold_over_;
      progress = false;
      for (Index e = 0; e < surface_.edge_count(); ++e)
        if (surface_.is_alive(e) && state_[e] == EdgeState::kPutOff) enqueue(e);
      if ((edge = take()) == kNone) break;
    }
    const auto [u, v] = surface_.ends(edge);
    for (std::size_t f = 0; f < data_.frame_count; ++f) {
      const std::size_t a = u * data_.frame_count + f, b = v * data_.frame_count + f;
      minima_[f] = minimum(data_.quadrics[a] + data_.quadrics[b]).point;
    }
    if ((options_.topology == Topology::kPreserve && !surface_.keeps_topology(edge)) ||
        (check_fold_over_ && folds_over(edge))) {
      state_[edge] = EdgeState::kPutOff;
      continue;
    }
    apply(edge);
    progress = true;
  }
}

}  // namespace limber::eval
