// SPDX-License-Identifier: Apache-2.0
// The connectivity of a clip.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace limber {

using Index = std::uint32_t;
inline constexpr Index kNone = ~Index{0};

// Three corners, counter-clockwise seen from outside.
using Triangle = std::array<Index, 3>;

// Whether two corners are the same.
inline bool is_degenerate(const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }

// What does not move: fixed over a clip. Vertices may be isolated; triangles may be degenerate, repeated,
// and meet in any way. Invariant `corner-in-range`: every corner is less than vertex_count.
struct Mesh {
  Index vertex_count = 0;
  std::vector<Triangle> triangles;

  friend bool operator==(const Mesh&, const Mesh&) = default;
};

}  // namespace limber
