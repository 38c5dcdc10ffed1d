// SPDX-License-Identifier: Apache-2.0
// The code is ours; of Shamir, Bajaj & Pascucci 2000 it has that a graph of all frames' hierarchies is made, whose
// nodes have life times.
//
//   write:  of the living nodes, parents first, which end
//           what an ended node held together falls to the next node above that lives on, or to no one
//           how many nodes begin
//           of the pairs of neighbours in one such group, whether a node begins that is their union; a node that has
//           begun makes new pairs with its neighbours in the group
//   Where two are left the group needs no word: they make up its node. A set of vertices comes up once, so that nothing
//   is asked twice. Models learn over the frames.
#include "eval/methods/t_dag_code.h"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>
#include <utility>

#include "limber/stream/range_coder.h"

namespace limber::eval {
namespace {

using Footprint = Forest::Footprint;

// The footprints, in one hierarchy, of the nodes of another.
std::vector<Footprint> footprints(const Forest& nodes, const Forest& in) {
  std::vector<Footprint> out(nodes.node_count(), {kNone, 0, 0});
  for (Index v = 0; v < nodes.vertex_count(); ++v) out[v] = in.footprint(v);
  for (Index node = 0; node < nodes.node_count(); ++node) {
    const Index parent = nodes.parent(node);
    if (parent != kNone) out[parent] = Forest::join(out[parent], out[node]);
  }
  return out;
}

// Number classes for models: 1, 2, 3 to 4, 5 to 8, ... are 0, 1, 2, 3, ...
std::size_t size_class(Index number, std::size_t class_count) {
  return std::min<std::size_t>(std::bit_width(number - 1), class_count - 1);
}

using Pair = std::array<Index, 2>;

// What is put together anew out of the nodes that live on. Nodes are numbered as before, new ones after them.
class Groups {
 public:
  // lives: [node_count] of `before`.
  Groups(const Forest& before, const std::vector<bool>& lives, const Edges& edges)
      : top_(before.node_count()), merged_into_(top_, kNone), groups_(top_), neighbours_(top_) {
    sizes_.assign(top_ + 1, 0);
    open_.assign(top_ + 1, 0);
    for (Index node = top_; node-- > 0;) {
      const Index parent = before.parent(node);
      groups_[node] = parent == kNone ? top_ : lives[parent] ? parent : groups_[parent];
      if (lives[node]) ++sizes_[groups_[node]];
    }
    for (auto [a, b] : edges.ends) {
      // Up to where both are in one group, which has the least number of those that hold both.
      while (groups_[a] != groups_[b]) (groups_[a] < groups_[b] ? a : b) = std::min(groups_[a], groups_[b]);
      if (!is_settled(groups_[a])) pairs_.push_back({std::min(a, b), std::max(a, b)});
    }
    std::ranges::sort(pairs_);
    pairs_.erase(std::unique(pairs_.begin(), pairs_.end()), pairs_.end());
    for (const auto [a, b] : pairs_) meet(a, b);
  }

  // The next pair that may become one; false when there is none.
  bool next(Pair& pair) {
    for (; at_ < pairs_.size(); ++at_) {
      pair = pairs_[at_];
      const Index group = groups_[pair[0]];
      --open_[group];
      if (merged_into_[pair[0]] == kNone && merged_into_[pair[1]] == kNone && !is_settled(group)) return ++at_, true;
    }
    return false;
  }

  // Gives the node that the pair becomes.
  Index join(const Pair& pair) {
    const Index node = static_cast<Index>(merged_into_.size()), group = groups_[pair[0]];
    merged_into_.push_back(kNone);
    groups_.push_back(group);
    --sizes_[group];
    std::vector<Index> around;
    for (const Index part : pair) {
      merged_into_[part] = node;
      for (const Index neighbour : neighbours_[part]) around.push_back(whole(neighbour));
    }
    std::ranges::sort(around);
    around.erase(std::unique(around.begin(), around.end()), around.end());
    std::erase(around, node);
    neighbours_.emplace_back();
    for (const Index neighbour : around) {
      pairs_.push_back({neighbour, node});
      meet(neighbour, node);
    }
    return node;
  }

  bool is_top(Index node) const { return groups_[node] == top_; }
  Index size(Index node) const { return sizes_[groups_[node]]; }  // of its group
  Index open(Index node) const { return open_[groups_[node]]; }   // pairs of its group that are still to come
  Index node_count() const { return static_cast<Index>(merged_into_.size()); }
  Index parent(Index node) const {
    return merged_into_[node] != kNone ? merged_into_[node] : is_top(node) ? kNone : groups_[node];
  }

 private:
  bool is_settled(Index group) const { return group != top_ && sizes_[group] == 2; }
  Index whole(Index node) const {
    while (merged_into_[node] != kNone) node = merged_into_[node];
    return node;
  }
  void meet(Index a, Index b) {
    neighbours_[a].push_back(b);
    neighbours_[b].push_back(a);
    ++open_[groups_[a]];
  }

  Index top_;                                   // the group of what is below no node
  std::vector<Index> merged_into_;              // [node_count()]: a new node; kNone
  std::vector<Index> groups_;                   // [node_count()]: the next node above that lives on
  std::vector<std::vector<Index>> neighbours_;  // [node_count()]: in the same group; they may have been merged since
  std::vector<Index> sizes_, open_;             // [top_ + 1]: by group
  std::vector<Pair> pairs_;
  std::size_t at_ = 0;
};

// The hierarchy of the nodes that live, numbered by their sizes.
Forest gather(Index vertex_count, const std::vector<bool>& lives, const std::vector<Footprint>& sets,
              const Groups& groups) {
  std::vector<Index> order;
  for (Index node = 0; node < groups.node_count(); ++node)
    if (node >= lives.size() || lives[node]) order.push_back(node);
  std::stable_sort(order.begin() + vertex_count, order.end(),
                   [&](Index a, Index b) { return sets[a].count < sets[b].count; });
  std::vector<Index> number(groups.node_count(), kNone), parent(order.size());
  for (Index i = 0; i < order.size(); ++i) number[order[i]] = i;
  for (Index i = 0; i < order.size(); ++i) {
    const Index above = groups.parent(order[i]);
    parent[i] = above == kNone ? kNone : number[above];
  }
  return Forest(vertex_count, std::move(parent));
}

}  // namespace

struct TDagCode::Models {
  std::array<std::array<BitModel, 4>, 3> ends;  // by what became of the parent, and by size
  DifferenceModel surplus;                      // of nodes that begin over those that end
  // By the size of the group, the pairs that it has left, and the sizes of both parts.
  std::array<std::array<std::array<std::array<BitModel, 4>, 4>, 5>, 5> joins;
};

TDagCode::TDagCode(const Mesh& mesh)
    : edges_(find_edges(mesh)), living_(mesh.vertex_count), models_(std::make_unique<Models>()) {}
TDagCode::~TDagCode() = default;
TDagCode::TDagCode(TDagCode&&) noexcept = default;
TDagCode& TDagCode::operator=(TDagCode&&) noexcept = default;

template <class Coder>
void TDagCode::code(Coder& coder, const Forest* forest) {
  const Index vertex_count = living_.vertex_count(), node_count = living_.node_count();
  std::vector<Footprint> sets = footprints(living_, living_), wanted;
  if constexpr (Coder::kEncodes) wanted = footprints(living_, *forest);

  std::vector<bool> lives(node_count, true);
  ended_ = 0;
  for (Index node = node_count; node-- > vertex_count;) {
    const Index parent = living_.parent(node);
    BitModel& model = models_->ends[parent == kNone ? 0 : lives[parent] ? 1 : 2][size_class(sets[node].count / 2, 4)];
    bool ends = false;
    if constexpr (Coder::kEncodes) ends = !forest->is_node(wanted[node]);
    ends = coder.bit(model, ends) != 0;
    lives[node] = !ends;
    ended_ += ends;
  }

  std::int32_t surplus = 0;
  if constexpr (Coder::kEncodes)
    surplus = static_cast<std::int32_t>(forest->node_count()) - static_cast<std::int32_t>(node_count);
  surplus = models_->surplus.code(coder, surplus);
  // Of bytes that no encoder writes it may be any number: then what there is to ask comes to an end.
  const Index to_come = ended_ + static_cast<Index>(surplus);

  Groups groups(living_, lives, edges_);
  born_ = 0;
  for (Pair pair; born_ != to_come && groups.next(pair);) {
    const auto [a, b] = pair;
    const Footprint both = Forest::join(sets[a], sets[b]);
    if (living_.is_node(both)) continue;  // it has ended
    const std::size_t group_class = groups.is_top(a) ? 4 : size_class(groups.size(a) - 2, 4);
    BitModel& model = models_->joins[group_class][size_class(groups.open(a) + 1, 5)][size_class(sets[a].count, 4)]
                                    [size_class(sets[b].count, 4)];
    bool begins = false;
    if constexpr (Coder::kEncodes) begins = forest->is_node(Forest::join(wanted[a], wanted[b]));
    if (!coder.bit(model, begins)) continue;
    groups.join(pair);
    sets.push_back(both);
    if constexpr (Coder::kEncodes) wanted.push_back(Forest::join(wanted[a], wanted[b]));
    ++born_;
  }
  living_ = gather(vertex_count, lives, sets, groups);
}

std::vector<std::byte> TDagCode::encode(const Forest& forest) {
  RangeEncoder coder;
  code(coder, &forest);
  return coder.finish();
}

void TDagCode::decode(std::span<const std::byte> bytes) {
  RangeDecoder coder(bytes);
  code(coder, nullptr);
}

}  // namespace limber::eval
