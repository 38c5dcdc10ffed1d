// SPDX-License-Identifier: Apache-2.0
//   find_below                             a few finest vertices below the node
//   list_far_ends                          where edges lead from them, as nodes of the node's level
//   candidates                             the clusters that those are in, each with its edges, sorted
#include "limber/stream/clusters.h"

#include <algorithm>
#include <array>

namespace limber {
namespace {

// More vertices and edges than these find hardly a cluster that is not found already, but a coarse node has thousands.
constexpr std::size_t kMostBelow = 8;
constexpr std::size_t kFewBelow = 4;  // so many stand for what is below them by one child each
constexpr std::size_t kMostEdges = 64;

template <std::size_t kMost>
struct FewNodes {
  std::array<Index, kMost> nodes;
  std::size_t count = 0;

  std::span<Index> all() { return std::span(nodes).first(count); }
};

// On the way down all children of few nodes are taken, and one child of each of more.
FewNodes<kMostBelow> find_below(const ChildLists& children, Index level, Index node) {
  FewNodes<kMostBelow> below;
  below.nodes[below.count++] = node;
  for (; level > 0; --level) {
    FewNodes<kMostBelow> next;
    const bool few = below.count < kFewBelow;
    for (const Index above : below.all()) {
      Index child = children.first_child(above);
      while (child != kNone && next.count < kMostBelow) {
        next.nodes[next.count++] = child;
        child = few ? children.next_sibling(child) : kNone;
      }
    }
    below = next;
  }
  return below;
}

// Edges go up level by level, all of them at once, so that a processor need not wait for one to fetch the next.
FewNodes<kMostEdges> list_far_ends(const IndexLists& neighbors, std::span<const Index> parent, Index level,
                                   std::span<const Index> below) {
  FewNodes<kMostEdges> ends;
  for (const Index vertex : below) {
    const auto ring = neighbors[vertex];
    for (const Index neighbor : ring.first(std::min(ring.size(), kMostEdges - ends.count)))
      ends.nodes[ends.count++] = neighbor;
  }
  for (; level > 0; --level)
    for (Index& end : ends.all()) end = parent[end];
  return ends;
}

// There are too few for anything better.
void insertion_sort(std::span<Candidate> candidates) {
  const auto comes_before = [](const Candidate& a, const Candidate& b) {
    return a.edge_count != b.edge_count ? a.edge_count > b.edge_count : a.parent < b.parent;
  };
  for (std::size_t i = 1; i < candidates.size(); ++i) {
    const Candidate candidate = candidates[i];
    std::size_t at = i;
    for (; at > 0 && comes_before(candidate, candidates[at - 1]); --at) candidates[at] = candidates[at - 1];
    candidates[at] = candidate;
  }
}

}  // namespace

Clusters::Clusters(std::span<const Index> level_begin, const IndexLists& neighbors)
    : level_begin_(level_begin),
      neighbors_(neighbors),
      parent_(level_begin.back(), kNone),
      children_(level_begin.back()),
      candidates_(kMostEdges),
      changed_(level_begin.back() - level_begin[1]) {}

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

// Most edges stay in the own cluster: they are dropped without a branch, which nothing could foretell.
std::span<const Candidate> Clusters::candidates(Index level, Index node, std::uint32_t& own_edge_count) {
  auto below = find_below(children_, level, node);
  auto ends = list_far_ends(neighbors_, parent_, level, below.all());
  const Index own = parent_[node];
  own_edge_count = 0;
  std::size_t out_count = 0;
  for (const Index end : ends.all()) {
    const Index cluster = parent_[end];
    const std::uint32_t leaves = (end != node) & (cluster != kNone), is_own = cluster == own;
    own_edge_count += leaves & is_own;
    ends.nodes[out_count] = cluster;
    out_count += leaves & ~is_own;
  }

  std::size_t count = 0;
  for (const Index cluster : std::span(ends.nodes).first(out_count)) {
    std::size_t at = 0;
    while (at < count && candidates_[at].parent != cluster) ++at;
    if (at == count) candidates_[count++] = {cluster, 0};
    ++candidates_[at].edge_count;
  }
  const std::span found = std::span(candidates_).first(count);
  insertion_sort(found);
  return found;
}

}  // namespace limber
