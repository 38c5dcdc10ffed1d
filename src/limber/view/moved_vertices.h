// SPDX-License-Identifier: Apache-2.0
// Which vertices of a cut the swaps of a frame have changed.
// Part of the player: standard library only.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "limber/hierarchy/hierarchy.h"
#include "limber/view/cut.h"

namespace limber {

// Sets moved[v] ([vertex_count]) to 1 where, in this cut, the swaps took finest vertices from those that the vertex
// stands for, or gave it some; else to 0. Moves within what one vertex stands for, and of nodes that are drawn
// themselves before and after, change nothing. Does not allocate. `old_parents`: [node_count], before the swaps.
// `vertex_of_node`: [node_count], that of ExtractScratch. Precondition: the cut's last update saw the swaps.
void mark_moved(std::span<const Swap> swaps, std::span<const Index> old_parents, const Cut& cut,
                std::span<const Index> vertex_of_node, std::span<std::uint8_t> moved);

}  // namespace limber
