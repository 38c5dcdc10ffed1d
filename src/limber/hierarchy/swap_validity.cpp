// SPDX-License-Identifier: Apache-2.0
// Kircher & Garland 2005, section 4.2: the pinch rule (no cluster may fall apart) and the homeomorphism rule (two
// clusters may share one chain of boundary only); section 4.3: at the level itself and at all coarser ones.
//
// Both are read off the labels of the neighbours, in the order in which they stand around v. `o` is the outside
// beyond a border, which counts as one more cluster. v moves from a to b:
//
//        c c                       The ring a a c c b b has three runs: a, c, b. Valid if
//      c     b                     - a has exactly one run (none: v is all that a has; two: v is a pinch vertex);
//     a   v   b                    - every other label has exactly one run;
//      a     b                     - a label whose run does not touch the run of b is not joined to b elsewhere:
//        d d                         v brings b into contact with all that stands around it.
//
// On coarser levels the ring is the same and the labels are the ancestors of that level.
#include "limber/hierarchy/swap_validity.h"

#include <algorithm>
#include <cassert>

namespace limber {

template <class Visit>
bool SwapValidity::any_of(Index cluster, Index levels_down, Visit&& visit) const {
  if (levels_down == 0) return visit(cluster);
  for (Index child = children_.first_child(cluster); child != kNone; child = children_.next_sibling(child))
    if (any_of(child, levels_down - 1, visit)) return true;
  return false;
}

// Whether a member of `cluster`, `except` aside, has a neighbour in `other`, or lies on a border if that is kNone.
bool SwapValidity::are_joined(const LevelGraph& graph, Index cluster, Index other, Index levels_up,
                              Index except) const {
  return any_of(cluster, levels_up, [&](Index member) {
    if (member == except) return false;
    if (other == kNone) return graph.star_of(member) != Star::kClosed;
    const auto around = graph.around(member);
    return std::any_of(around.begin(), around.end(),
                       [&](Index n) { return n != except && ancestor(n, levels_up) == other; });
  });
}

bool SwapValidity::keeps_homeomorphism(const LevelGraph& graph, Index node, Index from, Index to, Index levels_up) {
  runs_.clear();
  for (const Index n : graph.around(node)) {
    const Index label = ancestor(n, levels_up);
    if (runs_.empty() || runs_.back() != label) runs_.push_back(label);
  }
  if (graph.star_of(node) == Star::kBorder)
    runs_.push_back(kNone);  // the outside
  else if (runs_.size() > 1 && runs_.front() == runs_.back())
    runs_.pop_back();

  const std::size_t count = runs_.size();
  std::size_t to_at = count;
  bool from_found = false;
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t k = i + 1; k < count; ++k)
      if (runs_[i] == runs_[k]) return false;
    from_found |= runs_[i] == from;
    if (runs_[i] == to) to_at = i;
  }
  if (!from_found || to_at == count) return false;
  for (std::size_t i = 0; i < count; ++i) {
    if (i == to_at || (i + 1) % count == to_at || (to_at + 1) % count == i || runs_[i] == from) continue;
    if (are_joined(graph, to, runs_[i], levels_up, node)) return false;
  }
  return true;
}

// Whether the node has a neighbour in `to`, and those that it has in `from` are connected with each other inside `from`
// without it: searched from one of them until all are found.
bool SwapValidity::keeps_connection(const LevelGraph& graph, Index node, Index from, Index to, Index levels_up) {
  if (mark_.size() < hierarchy_.node_count() || stamp_ > kNone - 2) mark_.assign(hierarchy_.node_count(), stamp_ = 0);
  const Index sought = ++stamp_, found = ++stamp_;
  std::size_t left = 0;
  Index start = kNone;
  bool to_found = false;
  for (const Index n : graph.around(node)) {
    to_found |= ancestor(n, levels_up) == to;
    if (ancestor(n, levels_up) != from) continue;
    mark_[n] = sought;
    start = n;
    ++left;
  }
  if (left == 0 || !to_found) return false;
  reached_.assign(1, start);
  mark_[start] = found;
  --left;
  for (std::size_t i = 0; i < reached_.size() && left > 0; ++i) {
    for (const Index n : graph.around(reached_[i])) {
      if (mark_[n] == found || n == node || ancestor(n, levels_up) != from) continue;
      left -= mark_[n] == sought;
      mark_[n] = found;
      reached_.push_back(n);
    }
  }
  return left == 0;
}

bool SwapValidity::operator()(const LevelGraph& graph, Index node, Index to) {
  Index from = hierarchy_.parent[node];
  assert(from != kNone && from != to);
  const bool regular = graph.star_of(node) != Star::kIrregular;
  if (topology_ == Topology::kPreserve && !regular) return false;  // no promise could be kept around it
  for (Index levels_up = 1; from != to; ++levels_up) {
    if (!(topology_ == Topology::kPreserve ? keeps_homeomorphism(graph, node, from, to, levels_up)
                                           : keeps_connection(graph, node, from, to, levels_up)))
      return false;
    from = hierarchy_.parent[from];
    to = hierarchy_.parent[to];
    if (from == kNone) break;
  }
  return true;
}

}  // namespace limber
