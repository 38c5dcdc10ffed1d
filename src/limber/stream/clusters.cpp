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

// The finest descendants of `node`, without recursion: hierarchies may have any number of levels.
template <class Visit>
void Clusters::for_each_vertex(Index level, Index node, Visit&& visit) const {
  if (level == 0) return visit(node);
  Index at = node;
  Index at_level = level;
  while (true) {
    if (at_level > 1 && children_.first_child(at) != kNone) {
      at = children_.first_child(at);
      --at_level;
      continue;
    }
    if (at_level == 1)
      for (Index vertex = children_.first_child(at); vertex != kNone; vertex = children_.next_sibling(vertex))
        visit(vertex);
    while (at != node && children_.next_sibling(at) == kNone) {
      at = parent_[at];
      ++at_level;
    }
    if (at == node) return;
    at = children_.next_sibling(at);
  }
}

// Edges are counted without a branch: nothing foretells whether a cluster was met before, or is the node's own.
std::span<const Candidate> Clusters::candidates(Index level, Index node, std::uint32_t& own_edge_count) {
  const Index* const parent = parent_.data();
  std::uint32_t* const edge_count = edge_count_.data();
  Index* const found = found_.data();
  const Index no_cluster = level_begin_.back();
  std::size_t found_count = 0;
  std::uint32_t inner_edge_count = 0;  // these are among the edges to the own cluster
  for_each_vertex(level, node, [&](Index vertex) {
    for (Index label : neighbors_[vertex]) {
      for (Index k = 0; k < level; ++k) label = parent[label];
      inner_edge_count += label == node;
      const Index cluster = std::min(parent[label], no_cluster);
      found[found_count] = cluster;
      found_count += edge_count[cluster]++ == 0;
    }
  });

  const Index own = parent[node];
  own_edge_count = own == kNone ? 0 : edge_count[own] - inner_edge_count;
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
