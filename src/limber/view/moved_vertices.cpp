// SPDX-License-Identifier: Apache-2.0
#include "limber/view/moved_vertices.h"

#include <algorithm>

namespace limber {

void mark_moved(std::span<const Swap> swaps, std::span<const Index> old_parents, const Cut& cut,
                std::span<const Index> vertex_of_node, std::span<std::uint8_t> moved) {
  std::fill(moved.begin(), moved.end(), std::uint8_t{0});
  const std::span<const Index> labels = cut.labels();
  const auto mark = [&](Index node) {
    if (vertex_of_node[node] != kNone) moved[vertex_of_node[node]] = 1;
  };
  for (const Swap& swap : swaps) {
    const Index now = labels[swap.node], above = labels[old_parents[swap.node]];
    const Index before = above == kNone ? swap.node : above;
    if (before == now) continue;
    mark(before);
    if (now != kNone) mark(now);
  }
}

}  // namespace limber
