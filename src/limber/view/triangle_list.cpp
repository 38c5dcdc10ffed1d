// SPDX-License-Identifier: Apache-2.0
// Kircher & Garland 2005, section 5.1, list the triangles of a cut through degenerate sets. A flat pass over all finest
// triangles without branches is faster and knows nothing of what changed (docs/design.md):
//
//   for each finest triangle: write it down; count it if its three labels differ             keep_living
//   for each one kept: map the corners; skip it if the same triangle is there already     is_first
#include "limber/view/triangle_list.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstdint>
#include <span>

namespace limber {

namespace {

// Writes the living finest triangles of those asked for to the front of `faces` ([triangles.size()]) and gives their
// number.
template <class IsAsked>
[[gnu::noinline]] std::size_t keep_living(const Mesh& mesh, const Index* labels, Index* faces, IsAsked is_asked) {
  std::size_t kept = 0;
  const Triangle* triangles = mesh.triangles.data();
  const auto face_count = static_cast<Index>(mesh.triangles.size());
  for (Index face = 0; face < face_count; ++face) {
    const Triangle& t = triangles[face];
    const Index a = labels[t[0]], b = labels[t[1]], c = labels[t[2]];
    faces[kept] = face;
    kept += static_cast<std::size_t>((a != b) & (b != c) & (c != a) & is_asked(t));
  }
  return kept;
}

// The same for the three ways to begin a triangle.
std::uint32_t hash(Index a, Index b, Index c) {
  constexpr std::uint32_t kOdd = 0x9e3779b1u;
  const std::uint32_t x = a * kOdd, y = b * kOdd, z = c * kOdd;
  return ((x ^ x >> 15) + (y ^ y >> 15) + (z ^ z >> 15)) * 0x85ebca6bu;
}

bool is_same(const Triangle& t, Index a, Index b, Index c) {
  return (t[0] == a && t[1] == b && t[2] == c) || (t[0] == b && t[1] == c && t[2] == a) ||
         (t[0] == c && t[1] == a && t[2] == b);
}

// Open addressing: a slot holds the number of a listed triangle. Gives true, and takes a slot for `number`, if no
// triangle equal to (a, b, c) has one.
bool is_first(Index a, Index b, Index c, Index number, const Triangle* triangles, std::span<Index> slots) {
  const auto mask = static_cast<std::uint32_t>(slots.size() - 1);
  for (std::uint32_t slot = hash(a, b, c) >> 7 & mask;; slot = (slot + 1) & mask) {
    if (slots[slot] == kNone) {
      slots[slot] = number;
      return true;
    }
    if (is_same(triangles[slots[slot]], a, b, c)) return false;
  }
}

template <class IsAsked>
void list_those(const Mesh& mesh, std::span<const Index> label_of, TriangleList& list, IsAsked is_asked) {
  assert(label_of.size() >= mesh.vertex_count);
  const Index* labels = label_of.data();
  list.living.resize(mesh.triangles.size());
  const std::size_t living = keep_living(mesh, labels, list.living.data(), is_asked);
  list.triangles.resize(living);
  list.faces.resize(living);
  // At most a quarter full, so that the first slot looked at is nearly always empty.
  list.slots.assign(std::bit_ceil(4 * living + 1), kNone);

  const Index* faces = list.living.data();
  Triangle* triangles = list.triangles.data();
  Index kept = 0;
  for (std::size_t i = 0; i < living; ++i) {
    const Triangle& corners = mesh.triangles[faces[i]];
    const Index a = labels[corners[0]], b = labels[corners[1]], c = labels[corners[2]];
    triangles[kept] = {a, b, c};
    list.faces[kept] = faces[i];
    const bool is_finest = std::max({a, b, c}) < mesh.vertex_count;
    kept += is_finest || is_first(a, b, c, kept, triangles, list.slots);
  }
  list.triangles.resize(kept);
  list.faces.resize(kept);
}

}  // namespace

void list_triangles(const Mesh& mesh, std::span<const Index> labels, TriangleList& list) {
  list_those(mesh, labels, list, [](const Triangle&) { return true; });
}

void list_triangles_around(const Mesh& mesh, std::span<const Index> labels, std::span<const std::uint8_t> vertices,
                           TriangleList& list) {
  assert(vertices.size() == mesh.vertex_count);
  list_those(mesh, labels, list,
             [is_in = vertices.data()](const Triangle& t) { return (is_in[t[0]] | is_in[t[1]] | is_in[t[2]]) != 0; });
}

}  // namespace limber
