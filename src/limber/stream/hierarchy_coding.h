// SPDX-License-Identifier: Apache-2.0
// Coding the hierarchy of a key frame and the swaps of any other, for both directions. Part of the player.
//
// A parent is named by its rank among the clusters beside the node (clusters.h), one bit per rank: is it this one?
// Where it is none of them: one bit, is it the lowest without children? And if not, its number.
// Swaps go from the coarsest level to the finest, and are applied one by one, so that ranks follow them.
#pragma once

#include <array>
#include <bit>
#include <span>
#include <vector>

#include "limber/stream/clusters.h"
#include "limber/stream/range_coder.h"
#include "limber/stream/traversal.h"

namespace limber {

struct ParentModels {
  std::array<BitModel, 36> is_first;  // by level, number of candidates, and how clearly the first leads
  std::array<BitModel, 8> is_next;
  BitModel is_lowest_unused;
};

struct HierarchyModels {
  ParentModels key, swap;
  std::array<NumberModel, 3> swap_count;  // levels 0, 1, and above
  std::array<NumberModel, 3> node_gap;
};

// Gives the parent of `node`, kNone where the bytes are wrong. `unused`: no node of the level above that is lower
// has no children; it is advanced.
template <class Coder>
Index code_parent(Coder& coder, ParentModels& models, Clusters& clusters, Index level, Index node, Index& unused,
                  Index parent = kNone) {
  std::uint32_t own_edge_count = 0;
  const auto candidates = clusters.candidates(level, node, own_edge_count);
  for (std::size_t rank = 0; rank < candidates.size(); ++rank) {
    const std::uint32_t edge_count = candidates[rank].edge_count;
    const bool leads = rank + 1 == candidates.size() || edge_count > candidates[rank + 1].edge_count;
    BitModel* model = nullptr;
    if (rank == 0) {
      const std::size_t choice = candidates.size() < 3 ? candidates.size() - 1 : 2;
      const std::size_t pull = edge_count > own_edge_count ? 2u : edge_count == own_edge_count ? 1u : 0u;
      model = &models.is_first[((level > 0 ? 3u : 0u) + choice) * 6 + pull * 2 + (leads ? 1 : 0)];
    } else {
      model = &models.is_next[(rank < 4 ? rank : 4u) * 2 - 2 + (leads ? 1 : 0)];
    }
    if (coder.bit(*model, candidates[rank].parent == parent)) return candidates[rank].parent;
  }
  const Index first = clusters.level_begin()[level + 1], end = clusters.level_begin()[level + 2];
  while (unused < end && clusters.has_children(unused)) ++unused;
  if (coder.bit(models.is_lowest_unused, unused < end && unused == parent)) return unused < end ? unused : kNone;
  const auto bits = static_cast<unsigned>(std::bit_width(end - first - 1));
  const std::uint32_t named = code_plain(coder, bits, parent - first);
  return named < end - first ? first + named : kNone;
}

// Codes the parents of all nodes below the top, from the finest level up: vertices in the order of the traversal,
// nodes above by their first child in the order of the level below, those without any last. `parents`: [node_count]
// to write; not looked at when reading. `order`: room for the two largest levels. False where the bytes are wrong.
template <class Coder>
bool code_key_hierarchy(Coder& coder, HierarchyModels& models, Clusters& clusters, const Traversal& traversal,
                        std::span<Index> order, std::span<const Index> parents = {}) {
  const auto level_begin = clusters.level_begin();
  clusters.clear();
  std::copy(traversal.order.begin(), traversal.order.end(), order.begin());
  for (Index level = 0; level + 2 < level_begin.size(); ++level) {
    const Index first_above = level_begin[level + 1];
    const Index size = first_above - level_begin[level], size_above = level_begin[level + 2] - first_above;
    const auto above = order.subspan(size, size_above);
    Index above_count = 0;
    Index unused = first_above;
    for (const Index node : order.first(size)) {
      Index parent = kNone;
      if constexpr (Coder::kEncodes) parent = parents[node];
      parent = code_parent(coder, models.key, clusters, level, node, unused, parent);
      if (parent == kNone) return false;
      if (!clusters.has_children(parent)) above[above_count++] = parent;
      clusters.place({node, parent});
    }
    for (Index node = first_above; node < level_begin[level + 2]; ++node)
      if (!clusters.has_children(node)) above[above_count++] = node;
    std::copy(above.begin(), above.end(), order.begin());
  }
  return true;
}

// Codes the swaps of a frame and applies them to `clusters`. When writing, `swaps` are given by descending level,
// then ascending node; when reading, they are appended to `swaps`, which has room for a swap of every node.
// False where the bytes are wrong.
template <class Coder, class Swaps>
bool code_swaps(Coder& coder, HierarchyModels& models, Clusters& clusters, Swaps& swaps) {
  const auto level_begin = clusters.level_begin();
  std::size_t done = 0;
  for (Index level = static_cast<Index>(level_begin.size()) - 2; level-- > 0;) {
    const Index end = level_begin[level + 1];
    const std::size_t kind = level < 2 ? level : 2;
    std::uint32_t count = 0;
    if constexpr (Coder::kEncodes)
      while (done + count < swaps.size() && swaps[done + count].node >= level_begin[level]) ++count;
    count = models.swap_count[kind].code(coder, count);
    if (count > end - level_begin[level]) return false;
    Index next = level_begin[level];  // the lowest node that the next swap may move
    Index unused = end;
    for (std::uint32_t i = 0; i < count; ++i, ++done) {
      Swap swap;
      if constexpr (Coder::kEncodes) swap = swaps[done];
      const std::uint32_t gap = models.node_gap[kind].code(coder, swap.node - next);
      if (gap >= end - next) return false;
      const Index node = next + gap;
      const Index parent = code_parent(coder, models.swap, clusters, level, node, unused, swap.parent);
      if (parent == kNone || parent == clusters.parents()[node]) return false;
      const Index left = clusters.parents()[node];
      clusters.apply({node, parent});
      if (!clusters.has_children(left) && left < unused) unused = left;
      if constexpr (!Coder::kEncodes) swaps.push_back({node, parent});
      next = node + 1;
    }
  }
  return true;
}

}  // namespace limber
