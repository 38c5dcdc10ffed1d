// SPDX-License-Identifier: Apache-2.0
#include "limber/fourface/face_table.h"

#include <algorithm>
#include <cassert>

namespace limber {

FaceTable::FaceTable(const Mesh& mesh) : vertices_(mesh.vertex_count) {
  faces_.reserve(mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) {
    if (is_degenerate(t)) continue;
    const auto f = static_cast<Index>(faces_.size());
    faces_.push_back({.corners = t, .twins = {kNone, kNone, kNone}, .triangle = f});
    add_neighbours(faces_.back());
    for (Index i = 0; i < 3; ++i) vertices_[t[i]].outgoing = 4 * f + i;
  }
  face_count_ = static_cast<Index>(faces_.size());
  pair_half_edges(mesh);
  find_complex_vertices();
}

// Half-edges in buckets by their smaller end; in a bucket those with the same larger end are one edge.
void FaceTable::pair_half_edges(const Mesh& mesh) {
  std::vector<Index> begin(mesh.vertex_count + std::size_t{2}, 0);
  const auto for_each = [&](auto&& visit) {
    for (Index f = 0; f < faces_.size(); ++f) {
      for (Index i = 0; i < 3; ++i) {
        const Index a = faces_[f].corners[i], b = faces_[f].corners[i == 2 ? 0 : i + 1];
        a < b ? visit(a, b, 4 * f + i) : visit(b, a, 4 * f + i);
      }
    }
  };
  for_each([&](Index smaller, Index, Index) { ++begin[smaller + 2]; });
  for (Index v = 0; v < mesh.vertex_count; ++v) begin[v + 2] += begin[v + 1];
  struct Item {
    Index larger, half_edge;
  };
  std::vector<Item> items(begin.back());
  for_each([&](Index smaller, Index larger, Index h) { items[begin[smaller + 1]++] = {larger, h}; });

  const auto is_alike = [&](Index h, Index other) { return origin(h) == origin(other); };
  for (Index v = 0; v < mesh.vertex_count; ++v) {
    const Index end = begin[v + 1];
    for (Index i = begin[v]; i < end; ++i) {
      const Index h = items[i].half_edge;
      if (h == kNone) continue;
      Index count = 1, other = kNone;
      for (Index j = i + 1; j < end; ++j) {
        if (items[j].larger != items[i].larger || items[j].half_edge == kNone) continue;
        other = items[j].half_edge;
        items[j].half_edge = kNone;
        ++count;
      }
      if (count == 2 && !is_alike(h, other)) {
        join(h, other, false);
      } else {
        faces_[face_of(h)].add_line(h & 3);
        is_closed_ = false;
        if (count > 1) vertices_[v].complex = vertices_[items[i].larger].complex = true;
        if (count == 2) has_turned_edges_ = true;
      }
    }
  }
}

void FaceTable::find_complex_vertices() {
  std::vector<Index> faces_at(vertices_.size(), 0);
  for (const Face& face : faces_)
    for (const Index corner : face.corners) ++faces_at[corner];
  for (Index v = 0; v < vertices_.size(); ++v) {
    if (vertices_[v].outgoing == kNone || vertices_[v].complex) continue;
    const Index first = first_of_fan(vertices_[v].outgoing);
    Index in_fan = 0;
    for (Index h = first;;) {
      ++in_fan;
      h = twin(previous(h));
      if (h == kNone || h == first) break;
    }
    vertices_[v].complex = in_fan != faces_at[v];
  }
}

// The half-edge of the same vertex from which all of its fan is reached counter-clockwise.
Index FaceTable::first_of_fan(Index half_edge) const {
  Index first = half_edge;
  for (Index across = twin(first); across != kNone; across = twin(first)) {
    first = next(across);
    if (first == half_edge) break;
  }
  return first;
}

bool FaceTable::gather(Index v, Star& star) const {
  const Index start = vertices_[v].outgoing;
  if (start == kNone || vertices_[v].complex) return false;
  star.center = v;
  star.closed = true;
  std::uint32_t count = 0;
  Index first = start;
  for (Index h = start;;) {
    if (count + 2 > Star::kMostNeighbours) return false;
    const Face& f = faces_[face_of(h)];
    const Index corner = h & 3, before = corner == 0 ? 2 : corner - 1, after = corner == 2 ? 0 : corner + 1;
    star.spoke[count] = h;
    star.ring[count++] = f.corners[after];
    h = f.twins[before];
    if (h == first) break;
    if (h != kNone) continue;
    star.closed = false;
    const Index border = first_of_fan(start);
    if (border == first) {
      star.ring[count++] = f.corners[before];
      break;
    }
    // It began in the middle of the fan: once more, from the border on.
    count = 0;
    h = first = border;
  }
  star.count = count;
  return true;
}

void FaceTable::forget_old_edges() {
  for (Vertex& vertex : vertices_) vertex.neighbours = 0;
  for (const Face& face : faces_)
    if (face.corners[0] != kNone) add_neighbours(face);
}

bool FaceTable::find_edge(Index a, Index b) const {
  if (vertices_[a].complex) {
    if (vertices_[b].complex) return true;
    const Index c = a;
    a = b, b = c;
  }
  const Index start = vertices_[a].outgoing;
  Index h = start;
  do {
    const Face& f = faces_[face_of(h)];
    if (f.corners[0] == b || f.corners[1] == b || f.corners[2] == b) return true;
    h = twin(previous(h));
  } while (h != start && h != kNone);
  if (h == start) return false;
  for (h = twin(start); h != kNone; h = twin(h)) {
    h = next(h);
    const Face& f = faces_[face_of(h)];
    if (f.corners[0] == b || f.corners[1] == b || f.corners[2] == b) return true;
  }
  return false;
}

Index FaceTable::tag_edge(Index a, Index b) {
  if (vertices_[a].complex) {
    const Index c = a;
    a = b, b = c;
  }
  Star star;
  if (!gather(a, star)) return kNone;
  for (std::uint32_t i = 0; i < star.face_count(); ++i) {
    const Index h = star.spoke[i];
    if (star.ring[i] != b || twin(h) == kNone) continue;
    join(h, twin(h), true);
    return h;
  }
  return kNone;
}

void FaceTable::set(Index face, const std::array<Index, 3>& corners) {
  faces_[face].corners = corners;
  faces_[face].lines = 0;
  for (Index i = 0; i < 3; ++i) vertices_[corners[i]].outgoing = 4 * face + i;
  add_neighbours(faces_[face]);
}

void FaceTable::attach(Index face, unsigned side, const Outer& across) {
  faces_[face].twins[side] = across.twin;
  if (across.line) faces_[face].add_line(side);
  if (across.twin != kNone) faces_[face_of(across.twin)].twins[across.twin & 3] = 4 * face + side;
}

void FaceTable::join(Index half_edge, Index other, bool line) {
  const auto tie = [&](Index from, Index to) {
    Face& face = faces_[face_of(from)];
    face.twins[from & 3] = to;
    line ? face.add_line(from & 3) : face.drop_line(from & 3);
  };
  tie(half_edge, other);
  tie(other, half_edge);
}

void FaceTable::kill(Index face) {
  faces_[face].corners[0] = kNone;
  --face_count_;
}

//        r                 r
//      / | \             /   \         .
//     s  |  t    ->     s --- t
//      \ | /             \   /
//        v                 v
std::array<Index, 2> FaceTable::swap(Star& star, std::uint32_t place) {
  const Index spoke = star.spoke[place];
  const Index back = twin(spoke);
  const Index behind = face_of(back), ahead = face_of(spoke);
  const Index v = origin(spoke), r = origin(back), s = origin(previous(back)), t = origin(previous(spoke));
  const Outer vs = outer(next(back)), sr = outer(previous(back)), rt = outer(next(spoke)), tv = outer(previous(spoke));
  set(behind, {v, s, t});
  set(ahead, {s, r, t});
  attach(behind, 0, vs);
  attach(behind, 2, tv);
  attach(ahead, 0, sr);
  attach(ahead, 1, rt);
  join(4 * behind + 1, 4 * ahead + 2, false);
  star.spoke[place == 0 ? star.count - 1 : place - 1] = 4 * behind;
  for (std::uint32_t i = place; i + 1 < star.count; ++i) star.ring[i] = star.ring[i + 1];
  for (std::uint32_t i = place; i + 1 < star.face_count(); ++i) star.spoke[i] = star.spoke[i + 1];
  --star.count;
  return {behind, ahead};
}

std::array<Index, 2> FaceTable::remove_between_four(const Star& star, std::uint32_t first, bool line) {
  assert(star.closed && star.count == 4);
  std::array<Index, 4> ring, faces;
  std::array<Outer, 4> outers;
  for (std::uint32_t i = 0; i < 4; ++i) {
    const std::uint32_t at = (first + i) % 4;
    ring[i] = star.ring[at];
    faces[i] = face_of(star.spoke[at]);
    outers[i] = outer(next(star.spoke[at]));
  }
  set(faces[0], {ring[0], ring[1], ring[2]});
  set(faces[2], {ring[0], ring[2], ring[3]});
  attach(faces[0], 0, outers[0]);
  attach(faces[0], 1, outers[1]);
  attach(faces[2], 1, outers[2]);
  attach(faces[2], 2, outers[3]);
  join(4 * faces[0] + 2, 4 * faces[2], line);
  kill(faces[1]);
  kill(faces[3]);
  vertices_[star.center].outgoing = kNone;
  return {faces[0], faces[2]};
}

Index FaceTable::remove_between_three(const Star& star) {
  assert(star.count == 3);
  const std::size_t faces = star.face_count();
  const Index kept = face_of(star.spoke[0]);
  std::array<Outer, 3> outers{Outer{kNone, true}, Outer{kNone, true}, Outer{kNone, true}};
  for (std::size_t i = 0; i < faces; ++i) outers[i] = outer(next(star.spoke[i]));
  for (std::size_t i = 1; i < faces; ++i) kill(face_of(star.spoke[i]));
  set(kept, {star.ring[0], star.ring[1], star.ring[2]});
  for (unsigned i = 0; i < 3; ++i) attach(kept, i, outers[i]);
  vertices_[star.center].outgoing = kNone;
  return kept;
}

}  // namespace limber
