// SPDX-License-Identifier: Apache-2.0
//   pair_up(level):
//     births: for each cluster, the child that gains most by leaving it and founding a new one      dearest first
//     deaths: for each cluster, the neighbour that takes all its children at the least cost         cheapest first
//     while the next birth gains more than hysteresis x the cost of the next death, and more than `least`:
//       the children of the dying cluster move to its heir, one after the other; each move is a swap, the last a
//       contraction, so that validity is that of swap_validity.h
//       the cluster begins again as the founder's; other children follow where that gains
//
// A cluster changes once a round: what was found out about the others holds.
#include "limber/hierarchy/rebirth.h"

#include <algorithm>

namespace limber {
namespace {

// The next of those whose turn may come: only few are looked at, so that they are kept as heaps.
constexpr auto kLessGain = [](const auto& a, const auto& b) {
  return a.gain != b.gain ? a.gain < b.gain : a.cluster > b.cluster;
};
constexpr auto kMoreCost = [](const auto& a, const auto& b) {
  return a.cost != b.cost ? a.cost > b.cost : a.cluster > b.cluster;
};

template <class Event, class Order>
void drop_first(std::vector<Event>& heap, Order order) {
  std::pop_heap(heap.begin(), heap.end(), order);
  heap.pop_back();
}

}  // namespace

void Rebirth::find_births(const LevelGraph& graph, double least) {
  births_.clear();
  const Hierarchy& h = clusters_.hierarchy();
  const Index level = h.level_of(graph.first_node) + 1;
  for (Index cluster = h.level_begin[level]; cluster < h.level_begin[level + 1]; ++cluster) {
    if (clusters_.has_one_child(cluster) || !(clusters_.energy(cluster) > least)) continue;
    Birth best{least, cluster, kNone};
    for (const Index child : clusters_.children().of(cluster)) {
      if (!(worth_.about_release(child) > Worth::kLikely * (best.gain + clusters_.energy(child)))) continue;
      const double gain = worth_.release(child) - clusters_.energy(child);
      if (gain > best.gain) best.gain = gain, best.founder = child;
    }
    if (best.founder != kNone) births_.push_back(best);
  }
  std::make_heap(births_.begin(), births_.end(), kLessGain);
}

// Those that may cost no more than `most`.
void Rebirth::find_deaths(const LevelGraph& coarser, double most) {
  deaths_.clear();
  for (Index cluster = coarser.first_node; cluster < coarser.first_node + coarser.size(); ++cluster) {
    // Of all heirs the one that seems best; only its cost is found exactly, where it may pay for the dearest birth.
    Death best{0, cluster, kNone};
    for (const Index heir : coarser.around(cluster)) {
      const double burden = worth_.about_burden(clusters_.quadric(cluster), heir);
      if (best.heir == kNone || burden < best.cost) best.cost = burden, best.heir = heir;
    }
    if (best.heir == kNone || Worth::kLikely * (best.cost - clusters_.energy(cluster)) > most) continue;
    best.cost = -worth_.of_death(cluster, best.heir);
    deaths_.push_back(best);
  }
  std::make_heap(deaths_.begin(), deaths_.end(), kMoreCost);
}

// None where the budget does not allow it.
bool Rebirth::move(const LevelGraph& graph, Index node, Index to) {
  const Index from = clusters_.parent(node);
  if (!budget_.move(clusters_, graph, node, to)) return false;
  moves_.push_back({node, from});
  return true;
}

void Rebirth::undo() {
  for (; !moves_.empty(); moves_.pop_back()) clusters_.move(moves_.back().node, moves_.back().parent);
  budget_.undo();
}

// Moves all children over; none where that is not valid.
bool Rebirth::end(const LevelGraph& graph, const Death& death) {
  moves_.clear();
  budget_.keep();
  bool is_stuck = false;
  while (!is_stuck) {
    is_stuck = true;
    for (Index child = clusters_.children().first_child(death.cluster), next; child != kNone; child = next) {
      next = clusters_.children().next_sibling(child);
      const bool last = clusters_.has_one_child(death.cluster);
      if (!(last ? is_valid_.may_end(graph, child, death.heir) : is_valid_(graph, child, death.heir))) continue;
      if (!move(graph, child, death.heir)) continue;
      if (last) return true;
      is_stuck = false;
    }
  }
  undo();
  return false;
}

// The new cluster takes what else gains by it from the old one.
void Rebirth::grow(const LevelGraph& graph, Index old, Index cluster) {
  while (true) {
    double most = 0;
    Index best = kNone;
    for (const Index child : clusters_.children().of(old)) {
      const double gain = worth_.of_swap(child, cluster);
      if (gain > most && is_valid_(graph, child, cluster)) most = gain, best = child;
    }
    if (best == kNone || !move(graph, best, cluster)) return;
  }
}

// `cluster` is empty.
bool Rebirth::found(const LevelGraph& graph, const Birth& birth, Index cluster) {
  if (!is_valid_.may_found(graph, birth.founder)) return false;
  const Index parent = clusters_.parent(birth.cluster), parent_before = clusters_.parent(cluster);
  if (parent_before != parent) clusters_.move(cluster, parent);
  if (!move(graph, birth.founder, cluster)) {
    if (parent_before != parent) clusters_.move(cluster, parent_before);
    return false;
  }
  grow(graph, birth.cluster, cluster);
  return true;
}

const std::vector<Index>& Rebirth::pair_up(const LevelGraph& graph, const LevelGraph& coarser, double least,
                                           const RebirthOptions& options) {
  changed_.clear();
  if (!(options.hysteresis > 0)) return changed_;
  find_births(graph, least);
  if (births_.empty()) return changed_;
  find_deaths(coarser, births_.front().gain / options.hysteresis);
  const auto pays = [&](const Birth& birth, const Death& death) {
    return birth.gain > options.hysteresis * death.cost && birth.gain - death.cost > least;
  };
  const auto lock = [&](Index cluster) {
    if (!is_locked_[cluster]) changed_.push_back(cluster);
    is_locked_[cluster] = 1;
  };
  bool is_vacant = false;  // the first death's cluster is empty
  for (; !births_.empty(); drop_first(births_, kLessGain)) {
    const Birth& birth = births_.front();
    if (is_locked_[birth.cluster]) continue;
    for (; !is_vacant && !deaths_.empty() && pays(birth, deaths_.front()); drop_first(deaths_, kMoreCost)) {
      const Death& death = deaths_.front();
      if (is_locked_[death.cluster] || is_locked_[death.heir] || death.cluster == birth.cluster ||
          death.heir == birth.cluster)
        continue;
      if ((is_vacant = end(graph, death))) break;
    }
    if (deaths_.empty() || !pays(birth, deaths_.front())) break;
    const Death& death = deaths_.front();
    if (!is_vacant || birth.cluster == death.heir || birth.cluster == death.cluster) continue;
    if (!found(graph, birth, death.cluster)) continue;
    is_vacant = false;
    lock(birth.cluster), lock(death.cluster), lock(death.heir);
    drop_first(deaths_, kMoreCost);
  }
  if (is_vacant) undo();
  for (const Index cluster : changed_) is_locked_[cluster] = 0;
  return changed_;
}

}  // namespace limber
