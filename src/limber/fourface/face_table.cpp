// SPDX-License-Identifier: Apache-2.0
#include "limber/fourface/face_table.h"

#include <cassert>

namespace limber {

FaceTable::FaceTable(const Mesh& mesh) : outgoing_(mesh.vertex_count, kNone), complex_(mesh.vertex_count, 0) {
  faces_.reserve(mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) {
    if (is_degenerate(t)) continue;
    const auto f = static_cast<Index>(faces_.size());
    faces_.push_back({t, {kNone, kNone, kNone}, f});
    for (Index i = 0; i < 3; ++i) outgoing_[t[i]] = 4 * f + i;
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
        faces_[face_of(h)].lines |= static_cast<std::uint8_t>(1u << (h & 3));
        if (count > 1) complex_[v] = complex_[items[i].larger] = 1;
        if (count == 2) has_turned_edges_ = true;
      }
    }
  }
}

void FaceTable::find_complex_vertices() {
  std::vector<Index> faces_at(outgoing_.size(), 0);
  for (const Face& face : faces_)
    for (const Index corner : face.corners) ++faces_at[corner];
  for (Index v = 0; v < outgoing_.size(); ++v) {
    if (outgoing_[v] == kNone || complex_[v]) continue;
    const Index first = first_of_fan(outgoing_[v]);
    Index in_fan = 0;
    for (Index h = first;;) {
      ++in_fan;
      h = twin(previous(h));
      if (h == kNone || h == first) break;
    }
    complex_[v] = in_fan != faces_at[v];
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
  const Index start = outgoing_[v];
  if (start == kNone || complex_[v]) return false;
  star.center = v;
  star.closed = true;
  std::uint32_t count = 0;
  Index first = start;
  for (Index h = start;;) {
    if (count + 2 > Star::kMostNeighbours) return false;
    star.spoke[count] = h;
    star.ring[count++] = target(h);
    const Index back = previous(h);
    h = twin(back);
    if (h == first) break;
    if (h != kNone) continue;
    star.closed = false;
    const Index border = first_of_fan(start);
    if (border == first) {
      star.ring[count++] = origin(back);
      break;
    }
    // It began in the middle of the fan: once more, from the border on.
    count = 0;
    h = first = border;
  }
  star.count = count;
  return true;
}

bool FaceTable::has_edge(Index a, Index b) const {
  if (complex_[a]) {
    if (complex_[b]) return true;
    const Index c = a;
    a = b, b = c;
  }
  const Index start = outgoing_[a];
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
  if (complex_[a]) {
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
  for (Index i = 0; i < 3; ++i) outgoing_[corners[i]] = 4 * face + i;
}

void FaceTable::attach(Index face, int side, const Outer& across) {
  const Index h = 4 * face + static_cast<Index>(side);
  if (across.twin != kNone) return join(h, across.twin, across.line);
  faces_[face].twins[static_cast<std::size_t>(side)] = kNone;
  faces_[face].lines |= static_cast<std::uint8_t>(1u << side);
}

void FaceTable::join(Index half_edge, Index other, bool line) {
  const auto tie = [&](Index from, Index to) {
    Face& face = faces_[face_of(from)];
    const auto bit = static_cast<std::uint8_t>(1u << (from & 3));
    face.twins[from & 3] = to;
    face.lines = static_cast<std::uint8_t>(line ? face.lines | bit : face.lines & ~bit);
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
  outgoing_[star.center] = kNone;
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
  for (int i = 0; i < 3; ++i) attach(kept, i, outers[static_cast<std::size_t>(i)]);
  outgoing_[star.center] = kNone;
  return kept;
}

}  // namespace limber
