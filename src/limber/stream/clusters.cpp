// SPDX-License-Identifier: Apache-2.0
#include "limber/stream/clusters.h"

#include <algorithm>

namespace limber {

Clusters::Clusters(std::span<const Index> level_begin, const IndexLists& neighbors)
    : level_begin_(level_begin),
      neighbors_(neighbors),
      parent_(level_begin.back(), kNone),
      first_child_(level_begin.back(), kNone),
      next_(level_begin.back(), kNone),
      previous_(level_begin.back(), kNone),
      slot_(level_begin.back(), kNone),
      candidates_(level_begin.back() - level_begin[1]),
      changed_(candidates_.size()) {}

void Clusters::clear() {
  std::fill(parent_.begin(), parent_.end(), kNone);
  std::fill(first_child_.begin(), first_child_.end(), kNone);
  forget_changes();
}

void Clusters::forget_changes() { std::fill(changed_.begin(), changed_.end(), std::uint8_t{0}); }

void Clusters::place(const Swap& swap) {
  parent_[swap.node] = swap.parent;
  link(swap.node);
}

void Clusters::apply(const Swap& swap) {
  const auto [node, to] = swap;
  changed_[parent_[node] - level_begin_[1]] = 1;
  changed_[to - level_begin_[1]] = 1;
  if (previous_[node] == kNone) {
    first_child_[parent_[node]] = next_[node];
  } else {
    next_[previous_[node]] = next_[node];
  }
  if (next_[node] != kNone) previous_[next_[node]] = previous_[node];
  parent_[node] = to;
  link(node);
}

std::span<const Candidate> Clusters::candidates(Index level, Index node, std::uint32_t& own_edge_count) {
  candidate_count_ = 0;
  own_edge_count = 0;
  gather(level, node, own_edge_count);
  const std::span found = std::span(candidates_).first(candidate_count_);
  for (const Candidate& candidate : found) slot_[candidate.parent] = kNone;
  std::sort(found.begin(), found.end(), [](const Candidate& a, const Candidate& b) {
    return a.edge_count != b.edge_count ? a.edge_count > b.edge_count : a.parent < b.parent;
  });
  return found;
}

void Clusters::link(Index node) {
  Index& first = first_child_[parent_[node]];
  previous_[node] = kNone;
  next_[node] = first;
  if (first != kNone) previous_[first] = node;
  first = node;
}

// Walks the finest descendants of `node` without recursion: hierarchies may have any number of levels.
void Clusters::gather(Index level, Index node, std::uint32_t& own_edge_count) {
  const Index own = parent_[node];
  const auto visit = [&](Index vertex) {
    for (Index label : neighbors_[vertex]) {
      for (Index k = 0; k < level; ++k) label = parent_[label];
      if (label == node) continue;
      const Index cluster = parent_[label];
      if (cluster == kNone) continue;
      if (cluster == own) {
        ++own_edge_count;
        continue;
      }
      if (slot_[cluster] == kNone) {
        slot_[cluster] = candidate_count_;
        candidates_[candidate_count_++] = {cluster, 0};
      }
      ++candidates_[slot_[cluster]].edge_count;
    }
  };
  Index at = node;
  Index at_level = level;
  while (true) {
    if (at_level > 0 && first_child_[at] != kNone) {
      at = first_child_[at];
      --at_level;
      continue;
    }
    if (at_level == 0) visit(at);
    while (at != node && next_[at] == kNone) {
      at = parent_[at];
      ++at_level;
    }
    if (at == node) return;
    at = next_[at];
  }
}

}  // namespace limber
