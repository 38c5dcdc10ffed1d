// SPDX-License-Identifier: Apache-2.0
// The best pruning of a tree for a price (Breiman, Friedman, Olshen and Stone's pruning as generalised by
// Chou, Lookabaugh and Gray, "Optimal pruning with applications to tree-structured source coding and modeling",
// 1989), where Kircher & Garland 2005 say no more than "cut".
//
//   gain(n)  = error(n)^2 - sum of error(child)^2
//   rank(n)  = max over trees T hanging from n of  gain(T) / price(T)              best_group, rank_nodes
//   rank(n)  = min(rank(n) x hysteresis if it was expanded, rank(parent))           rank_below_parents
//   in falling order of rank, parents first: expand n if it still fits              take_...
//
// For every rate r the nodes of rank above r are the tree that minimises error^2 + r x price, so that, but for the
// last few nodes that fill up the budget, no other cut of the same price has less error. A node by itself
// may gain little while a child of it gains much (an ear on a flat cheek); the maximum over trees sees that.
#include "limber/view/budget.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <limits>

namespace limber {

namespace {

// Ranks are floats >= 0, which order as their bits do. A bucket holds those with the same upper 16 bits: seven of the
// mantissa.
constexpr unsigned kDigitBits = 8;
constexpr std::uint32_t kDigitCount = 1u << kDigitBits;
constexpr unsigned kBucketShift = 31 - 2 * kDigitBits;

std::uint32_t bucket_of(float rank) { return std::bit_cast<std::uint32_t>(rank) >> kBucketShift; }

// Gains are of the order of 1, so that the smallest float is nothing among them; it makes what costs nothing, whatever
// it gains, infinite, without a branch. A gain that is no number counts as none.
float rate(double gain, std::uint32_t price) {
  return (std::max(0.0f, static_cast<float>(gain)) + std::numeric_limits<float>::min()) / static_cast<float>(price);
}

// Orders by rank, then by index: coarser nodes have higher indices, so that parents come out of a heap first.
std::uint64_t heap_key(float rank, Index node) {
  return std::uint64_t{std::bit_cast<std::uint32_t>(rank)} << 32 | node;
}
Index node_of(std::uint64_t key) { return static_cast<Index>(key); }

}  // namespace

void Budget::reserve(const Hierarchy& hierarchy) {
  const std::size_t size = hierarchy.node_count() - hierarchy.vertex_count();
  first_child_.resize(size);
  next_sibling_.resize(size);
  gain_.resize(size);
  rank_.resize(size);
  best_child_.resize(size);
  candidates_.reserve(size);
}

// Relative to the largest error of the top level, so that no unit of length leads beyond the range of a float.
void Budget::measure_gains(const Hierarchy& hierarchy, std::span<const float> errors) {
  const Index base = hierarchy.vertex_count();
  const Index below_top = hierarchy.level_begin[hierarchy.level_count() - 1] - base;
  const Index* parents = hierarchy.parent.data() + base;
  float largest = 0;
  for (const float error : errors.subspan(below_top)) largest = std::max(largest, error);
  const double scale = largest > 0 ? 1 / double{largest} : 1;
  for (auto n = static_cast<Index>(gain_.size()); n-- > below_top;) {
    const double error = scale * double{errors[n]};
    gain_[n] = error * error;
    first_child_[n] = kNone;
  }
  for (Index n = below_top; n-- > 0;) {
    const double error = scale * double{errors[n]};
    const Index parent = parents[n] - base;
    gain_[n] = error * error;
    gain_[parent] -= error * error;
    first_child_[n] = kNone;
    next_sibling_[n] = first_child_[parent];
    first_child_[parent] = n;
  }
}

// The tree hanging from `node` that contains each descendant whose rank and whose ancestors' ranks below `node` are
// above the threshold.
Budget::Group Budget::best_group(Index node, float threshold, std::span<const std::uint32_t> price) const {
  Group group{gain_[node], price[node]};
  for (Index child = first_child_[node]; child != kNone; child = next_sibling_[child]) {
    if (!(rank_[child] > threshold)) continue;
    const Group below = best_group(child, threshold, price);
    group.gain += below.gain;
    group.price += below.price;
  }
  return group;
}

// Dinkelbach's iteration for the best ratio: each round's ratio is the next round's threshold; it only rises, and the
// group only shrinks, so that it ends. Most nodes outrank their children and need no round.
void Budget::rank_nodes(const Hierarchy& hierarchy, std::span<const std::uint32_t> price) {
  const Index base = hierarchy.vertex_count();
  const Index below_top = hierarchy.level_begin[hierarchy.level_count() - 1] - base;
  const Index* parents = hierarchy.parent.data() + base;
  std::fill(best_child_.begin(), best_child_.end(), 0.0f);
  for (Index n = 0; n < rank_.size(); ++n) {
    float best = rate(gain_[n], price[n]);
    while (best < best_child_[n]) {
      const Group group = best_group(n, best, price);
      const float better = rate(group.gain, group.price);
      if (!(better > best)) break;
      best = better;
    }
    rank_[n] = best;
    if (n < below_top) {
      float& rival = best_child_[parents[n] - base];
      rival = std::max(rival, best);
    }
  }
}

void Budget::rank_below_parents(const Hierarchy& hierarchy, float hysteresis, std::span<const std::uint8_t> expanded) {
  const Index base = hierarchy.vertex_count();
  const Index below_top = hierarchy.level_begin[hierarchy.level_count() - 1] - base;
  const Index* parents = hierarchy.parent.data() + base;
  const float factor[2] = {1.0f, hysteresis};
  for (auto n = static_cast<Index>(rank_.size()); n-- > below_top;) rank_[n] *= factor[expanded[n]];
  for (Index n = below_top; n-- > 0;) rank_[n] = std::min(rank_[n] * factor[expanded[n]], rank_[parents[n] - base]);
}

// Radix selection: finds, a digit at a time, the bucket in which the budget ends; takes all nodes of the buckets above
// it, and gives what is left.
std::uint64_t Budget::take_whole_buckets(const Costs& costs, std::span<std::uint8_t> expanded) {
  const float* rank = rank_.data();
  const std::size_t size = rank_.size();
  std::uint64_t left = costs.budget;
  std::uint32_t prefix = 0;
  for (unsigned shift = kDigitBits;; shift = 0) {
    std::array<std::uint64_t, kDigitCount> price{};
    for (std::size_t n = 0; n < size; ++n) {
      const std::uint32_t digits = bucket_of(rank[n]) >> shift;
      price[digits & (kDigitCount - 1)] += digits >> kDigitBits == prefix ? costs.price[n] : 0;
    }
    std::uint32_t digit = kDigitCount;
    while (--digit > 0 && price[digit] <= left) left -= price[digit];
    prefix = prefix << kDigitBits | digit;
    if (shift == 0) break;
  }
  last_bucket_ = prefix;
  for (std::size_t n = 0; n < size; ++n) expanded[n] = bucket_of(rank[n]) > prefix;
  return left;
}

template <class Condition>
void Budget::gather(Condition condition) {
  candidates_.resize(rank_.size());
  std::size_t count = 0;
  for (Index n = 0; n < rank_.size(); ++n) {
    candidates_[count] = heap_key(rank_[n], n);
    count += condition(n);
  }
  candidates_.resize(count);
}

// Takes those candidates that fit, in order, and gives what is left. When nothing is, only nodes without a price can
// follow, and those have the rank of the parent that they follow.
std::uint64_t Budget::take_candidates(const Hierarchy& hierarchy, const Costs& costs, std::uint64_t left,
                                      std::span<std::uint8_t> expanded) {
  const Index base = hierarchy.vertex_count();
  const Index below_top = hierarchy.level_begin[hierarchy.level_count() - 1] - base;
  float last_rank = std::numeric_limits<float>::infinity();
  std::make_heap(candidates_.begin(), candidates_.end());
  while (!candidates_.empty()) {
    const Index n = node_of(candidates_.front());
    if (left == 0 && rank_[n] < last_rank) break;
    std::pop_heap(candidates_.begin(), candidates_.end());
    candidates_.pop_back();
    if (costs.price[n] > left) continue;
    if (n < below_top && !expanded[hierarchy.parent[base + n] - base]) continue;
    expanded[n] = 1;
    left -= costs.price[n];
    last_rank = rank_[n];
  }
  return left;
}

void Budget::take_by_rank(const Hierarchy& hierarchy, const Costs& costs, std::span<std::uint8_t> expanded) {
  std::uint64_t left = take_whole_buckets(costs, expanded);
  gather([&](Index n) -> bool { return bucket_of(rank_[n]) == last_bucket_; });
  left = take_candidates(hierarchy, costs, left, expanded);
  gather([&](Index n) -> bool {
    const bool later = bucket_of(rank_[n]) < last_bucket_, fits = costs.price[n] <= left;
    return later & fits;
  });
  take_candidates(hierarchy, costs, left, expanded);
}

void Budget::choose(const Hierarchy& hierarchy, const Costs& costs, float hysteresis,
                    std::span<std::uint8_t> expanded) {
  assert(hysteresis >= 1.0f);
  assert(costs.errors.size() == rank_.size() && costs.price.size() == rank_.size() && expanded.size() == rank_.size());
  if (rank_.empty()) return;
  measure_gains(hierarchy, costs.errors);
  rank_nodes(hierarchy, costs.price);
  rank_below_parents(hierarchy, hysteresis, expanded);
  take_by_rank(hierarchy, costs, expanded);
}

void Budget::choose_worst_first(const Hierarchy& hierarchy, const Costs& costs, float enough, float hysteresis,
                                std::span<std::uint8_t> expanded) {
  assert(hysteresis >= 1.0f && enough >= 0);
  assert(costs.errors.size() == rank_.size() && costs.price.size() == rank_.size() && expanded.size() == rank_.size());
  if (rank_.empty()) return;
  for (std::size_t n = 0; n < rank_.size(); ++n) rank_[n] = costs.errors[n] > enough ? costs.errors[n] : 0;
  rank_below_parents(hierarchy, hysteresis, expanded);
  take_by_rank(hierarchy, costs, expanded);
  for (std::size_t n = 0; n < rank_.size(); ++n) expanded[n] &= rank_[n] > 0;
}

}  // namespace limber
