// SPDX-License-Identifier: Apache-2.0
// What a program gets that links limber::player alone: the hierarchy of hierarchy.h's drawing, and one swap.
#include <cstdio>

#include "limber/hierarchy/hierarchy.h"
#include "limber/version.h"

int main() {
  using limber::kNone;
  limber::Hierarchy hierarchy{{0, 6, 9, 11}, {6, 6, 7, 7, 8, 8, 9, 9, 10, kNone, kNone}};
  apply(hierarchy, limber::Swap{.node = 3, .parent = 8});

  std::printf("limber %s: %u levels, vertex 3 now belongs to node %u\n", limber::kVersion, hierarchy.level_count(),
              hierarchy.parent[3]);
}
