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
//
// Births and deaths of clusters are neither in the paper. Where v is all that a has, its swap contracts the edge from a
// to b: a has no run then, and that all others touch b's run or do not touch b at all is the link condition. It does
// not see the case in which nothing is left to be a surface: with three runs, b must touch a fourth cluster. Where v
// founds a cluster, that is the inverse: every label has one run, and a corner of the level needs at least three.
#include "limber/hierarchy/swap_validity.h"

#include <algorithm>
#include <cassert>

namespace limber {

template <class Visit>
bool SwapValidity::any_of(Index cluster, Index levels_down, Visit&& visit) const {
  if (levels_down == 0) return visit(cluster);
  for (const Index child : children_.of(cluster))
    if (any_of(child, levels_down - 1, visit)) return true;
  return false;
}

// Whether the node has a neighbour, `except` aside, in the cluster.
bool SwapValidity::is_beside(const LevelGraph& graph, Index node, Index cluster, Index levels_up, Index except) const {
  const auto around = graph.around(node);
  return std::any_of(around.begin(), around.end(),
                     [&](Index n) { return n != except && ancestor(n, levels_up) == cluster; });
}

// Whether a member of `cluster`, `except` aside, has a neighbour in `other`, or lies on a border if that is kNone.
bool SwapValidity::are_joined(const LevelGraph& graph, Index cluster, Index other, Index levels_up,
                              Index except) const {
  return any_of(cluster, levels_up, [&](Index member) {
    if (member == except) return false;
    if (other == kNone) return graph.star_of(member) != StarKind::kClosed;
    return is_beside(graph, member, other, levels_up, except);
  });
}

bool SwapValidity::is_swappable(const LevelGraph& graph, Index node) const {
  return topology_ == Topology::kFree ||
         graph.star_of(node) != StarKind::kIrregular;  // no promise could be kept around it
}

// Fills runs_. Whether every label has no more than one.
bool SwapValidity::find_runs(const LevelGraph& graph, Index node, Index levels_up) {
  runs_.clear();
  for (const Index n : graph.around(node)) {
    const Index label = ancestor(n, levels_up);
    if (runs_.empty() || runs_.back() != label) runs_.push_back(label);
  }
  if (graph.star_of(node) == StarKind::kBorder)
    runs_.push_back(kNone);
  else if (runs_.size() > 1 && runs_.front() == runs_.back())
    runs_.pop_back();
  for (std::size_t i = 0; i < runs_.size(); ++i)
    if (std::find(runs_.begin() + static_cast<std::ptrdiff_t>(i) + 1, runs_.end(), runs_[i]) != runs_.end())
      return false;
  return true;
}

// Whether no label but those beside the run of `to`, and `from`, meets `to` without the node. Precondition: runs_.
bool SwapValidity::keeps_contacts(const LevelGraph& graph, Index node, Index from, Index to, Index levels_up) {
  const std::size_t count = runs_.size();
  const auto to_at = static_cast<std::size_t>(std::find(runs_.begin(), runs_.end(), to) - runs_.begin());
  if (to_at == count) return false;
  for (std::size_t i = 0; i < count; ++i) {
    if (i == to_at || (i + 1) % count == to_at || (to_at + 1) % count == i || runs_[i] == from) continue;
    if (are_joined(graph, to, runs_[i], levels_up, node)) return false;
  }
  return true;
}

bool SwapValidity::keeps_homeomorphism(const LevelGraph& graph, Index node, Index from, Index to, Index levels_up) {
  return find_runs(graph, node, levels_up) && std::find(runs_.begin(), runs_.end(), from) != runs_.end() &&
         keeps_contacts(graph, node, from, to, levels_up);
}

// Whether a member of the cluster, one level up, has a neighbour in a cluster that has no run. Precondition: runs_.
bool SwapValidity::touches_beyond_runs(const LevelGraph& graph, Index cluster, Index except) const {
  const auto has_run = [this](Index label) { return std::find(runs_.begin(), runs_.end(), label) != runs_.end(); };
  return any_of(cluster, 1, [&](Index member) {
    if (graph.star_of(member) != StarKind::kClosed && !has_run(kNone)) return true;
    const auto around = graph.around(member);
    return std::any_of(around.begin(), around.end(),
                       [&](Index n) { return n != except && !has_run(hierarchy_.parent[n]); });
  });
}

// Whether all clusters around the node, which is all that its own has, keep triangles without it. Precondition: runs_.
bool SwapValidity::leaves_surface(const LevelGraph& graph, Index node) const {
  return runs_.size() > 3 || std::all_of(runs_.begin(), runs_.end(), [&](Index label) {
           return label == kNone || touches_beyond_runs(graph, label, node);
         });
}

// Whether those neighbours that the node has in `from` are connected with each other inside `from` without it: searched
// from one of them until all are found.
bool SwapValidity::keeps_connection(const LevelGraph& graph, Index node, Index from, Index levels_up) {
  if (mark_.size() < hierarchy_.node_count() || stamp_ > kNone - 2) mark_.assign(hierarchy_.node_count(), stamp_ = 0);
  const Index sought = ++stamp_, found = ++stamp_;
  std::size_t left = 0;
  Index start = kNone;
  for (const Index n : graph.around(node)) {
    if (ancestor(n, levels_up) != from) continue;
    mark_[n] = sought;
    start = n;
    ++left;
  }
  if (left == 0) return false;
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

// The level of the labels and those above, up to the first cluster that holds both.
bool SwapValidity::is_valid_from(const LevelGraph& graph, Index node, Index from, Index to, Index levels_up) {
  for (; from != to; ++levels_up) {
    if (!(topology_ == Topology::kPreserve
              ? keeps_homeomorphism(graph, node, from, to, levels_up)
              : is_beside(graph, node, to, levels_up) && keeps_connection(graph, node, from, levels_up)))
      return false;
    from = hierarchy_.parent[from];
    to = hierarchy_.parent[to];
  }
  return true;
}

bool SwapValidity::operator()(const LevelGraph& graph, Index node, Index to) {
  const Index from = hierarchy_.parent[node];
  assert(from != kNone && from != to);
  return is_swappable(graph, node) && is_valid_from(graph, node, from, to, 1);
}

bool SwapValidity::may_end(const LevelGraph& graph, Index node, Index to) {
  const Index from = hierarchy_.parent[node];
  assert(children_.first_child(from) == node && children_.next_sibling(node) == kNone && from != to);
  if (!is_swappable(graph, node)) return false;
  if (topology_ == Topology::kPreserve
          ? !find_runs(graph, node, 1) || !keeps_contacts(graph, node, from, to, 1) || !leaves_surface(graph, node)
          : !is_beside(graph, node, to, 1))
    return false;
  return is_valid_from(graph, node, hierarchy_.parent[from], hierarchy_.parent[to], 2);
}

bool SwapValidity::may_found(const LevelGraph& graph, Index node) {
  const Index from = hierarchy_.parent[node];
  if (topology_ == Topology::kFree) return keeps_connection(graph, node, from, 1);
  return is_swappable(graph, node) && find_runs(graph, node, 1) && runs_.size() >= 3 &&
         std::find(runs_.begin(), runs_.end(), from) != runs_.end();
}

}  // namespace limber
