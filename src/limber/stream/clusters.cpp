// SPDX-License-Identifier: Apache-2.0
#include "limber/stream/clusters.h"

#include <algorithm>

namespace limber {

Clusters::Clusters(std::span<const Index> level_begin, const IndexLists& neighbors)
    : level_begin_(level_begin),
      neighbors_(neighbors),
      parent_(level_begin.back(), kNone),
      children_(level_begin.back()),
      edge_count_(std::size_t{level_begin.back()} + 1, 0),
      found_(std::size_t{level_begin.back()} - level_begin[1] + 2),
      candidates_(level_begin.back() - level_begin[1]),
      below_(level_begin.back() - level_begin[1] + std::size_t{1}),
      looked_up_(level_begin.size() > 2 ? level_begin[2] - level_begin[1] : 0),
      changed_(candidates_.size()) {}

void Clusters::clear() {
  std::fill(parent_.begin(), parent_.end(), kNone);
  children_.clear();
  forget_changes();
}

void Clusters::forget_changes() { std::fill(changed_.begin(), changed_.end(), std::uint8_t{0}); }

void Clusters::place(const Swap& swap) {
  parent_[swap.node] = swap.parent;
  children_.add(swap.node, swap.parent);
}

void Clusters::apply(const Swap& swap) {
  const auto [node, to] = swap;
  changed_[parent_[node] - level_begin_[1]] = 1;
  changed_[to - level_begin_[1]] = 1;
  children_.move(node, parent_[node], to);
  parent_[node] = to;
}

// Those of a node at least two levels above the finest: a neighbour is taken up to its cluster once for all vertices
// that it shares its own cluster with, and not at all where it lies below the node itself, as most do.
template <class Count>
void Clusters::for_each_edge_out(Index level, Index node, Count&& count) {
  const Index* const parent = parent_.data();
  const Index base = level_begin_[1], no_cluster = level_begin_.back();
  if (++round_ == 0) {
    std::fill(looked_up_.begin(), looked_up_.end(), LookedUp{});
    round_ = 1;
  }
  const std::uint32_t round = round_;
  LookedUp* const looked_up = looked_up_.data();
  below_[0] = node;
  std::size_t begin = 0, end = 1;
  for (Index at_level = level; at_level > 1; --at_level) {
    const std::size_t level_end = end;
    for (; begin < level_end; ++begin) {
      for (Index child = children_.first_child(below_[begin]); child != kNone; child = children_.next_sibling(child))
        below_[end++] = child;
    }
  }
  for (std::size_t i = begin; i < end; ++i) looked_up[below_[i] - base] = {round, no_cluster};
  for (std::size_t i = begin; i < end; ++i) {
    for (Index vertex = children_.first_child(below_[i]); vertex != kNone; vertex = children_.next_sibling(vertex)) {
      for (const Index neighbor : neighbors_[vertex]) {
        LookedUp& above = looked_up[parent[neighbor] - base];
        if (above.round != round) {
          Index label = parent[neighbor];
          for (Index k = 1; k <= level; ++k) label = parent[label];
          above = {round, std::min(label, no_cluster)};
        }
        if (above.cluster != no_cluster) count(above.cluster);
      }
    }
  }
}

template <class Count>
void Clusters::for_each_edge_out_of_fine(Index level, Index node, Count&& count) const {
  const Index* const parent = parent_.data();
  const Index no_cluster = level_begin_.back();
  if (level == 0) {
    for (const Index neighbor : neighbors_[node]) count(std::min(parent[neighbor], no_cluster));
    return;
  }
  for (Index vertex = children_.first_child(node); vertex != kNone; vertex = children_.next_sibling(vertex)) {
    for (const Index neighbor : neighbors_[vertex]) {
      const Index label = parent[neighbor];
      count(label == node ? no_cluster : std::min(parent[label], no_cluster));
    }
  }
}

// Edges are counted without a branch: nothing foretells whether a cluster was met before, or is the node's own.
std::span<const Candidate> Clusters::candidates(Index level, Index node, std::uint32_t& own_edge_count) {
  std::uint32_t* const edge_count = edge_count_.data();
  Index* const found = found_.data();
  const Index no_cluster = level_begin_.back();
  std::size_t found_count = 0;
  const auto count_edge = [&](Index cluster) {
    found[found_count] = cluster;
    found_count += edge_count[cluster]++ == 0;
  };
  if (level < 2) {
    for_each_edge_out_of_fine(level, node, count_edge);
  } else {
    for_each_edge_out(level, node, count_edge);
  }

  const Index own = parent_[node];
  own_edge_count = own == kNone ? 0 : edge_count[own];
  std::size_t count = 0;
  for (const Index cluster : std::span(found, found_count)) {
    if (cluster != own && cluster != no_cluster) candidates_[count++] = {cluster, edge_count[cluster]};
    edge_count[cluster] = 0;
  }
  const std::span candidates = std::span(candidates_).first(count);
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    return a.edge_count != b.edge_count ? a.edge_count > b.edge_count : a.parent < b.parent;
  });
  return candidates;
}

}  // namespace limber
