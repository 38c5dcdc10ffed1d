// SPDX-License-Identifier: Apache-2.0
// Distances from given triangles are upper bounds of the distance from a surface, and a good guess which triangle to
// try makes them tight: the one of the frame before, or that of a neighbour.
//
//   for each finest vertex: measure its distance from its witness          find, find_again
//   where too many have lost theirs: hand on those that are left           flood
//   while it helps: for each vertex beyond the limit:                      settle
//     try the triangles around it and the witnesses of its neighbours      improve
#include "limber/view/witnesses.h"

#include <algorithm>
#include <cassert>
#include <limits>

#include "limber/view/triangle_distance.h"

namespace limber {

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr int kSweeps = 12;

// As == says, without a call.
bool is_same(const Triangle& a, const Triangle& b) { return a[0] == b[0] && a[1] == b[1] && a[2] == b[2]; }

// The square of the distance of a place to the image of a face; infinite where that is not drawn.
float squared_distance_to_image(const DrawnSurface& drawn, const Vec3f& place, const Triangle& face) {
  const Index a = drawn.labels[face[0]], b = drawn.labels[face[1]], c = drawn.labels[face[2]];
  if ((a == b) | (b == c) | (c == a)) return kInfinity;
  return squared_distance_to_triangle(place, drawn.positions[a], drawn.positions[b], drawn.positions[c]);
}

}  // namespace

Witnesses::Witnesses(const Mesh& mesh)
    : faces_(mesh.vertex_count, Triangle{}),
      squared_bounds_(mesh.vertex_count, 0.0f),
      was_sought_(mesh.vertex_count, 0) {
  failing_.reserve(mesh.vertex_count);
  queue_.reserve(mesh.vertex_count);
  std::vector<std::pair<Index, Index>> edges;
  for (const Triangle& t : mesh.triangles) {
    if (is_degenerate(t)) continue;
    for (std::size_t k = 0; k < 3; ++k) edges.push_back(std::minmax({t[k], t[(k + 1) % 3]}));
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  for (const auto& [from, to] : edges) sides_.push_back({from, to});
}

// Tries the witnesses of the ends, the triangles around them, and the witnesses of the corners of these.
void Witnesses::improve_side(const Mesh& mesh, const Stars& stars, const DrawnSurface& drawn, Side& side,
                             float enough) {
  const Vec3f middle = 0.5f * (drawn.positions[side.from] + drawn.positions[side.to]);
  const auto offer_side = [&](const Triangle& face) {
    const float square = squared_distance_to_image(drawn, middle, face);
    if (!(square < side.square)) return;
    side.square = square;
    side.face = face;
  };
  for (const Index end : {side.from, side.to}) offer_side(faces_[end]);
  Triangle tried{};
  for (const Index end : {side.from, side.to}) {
    for (const Index number : stars.of(end)) {
      const Triangle& face = mesh.triangles[number];
      if (side.square <= enough) return;
      offer_side(face);
      for (const Index corner : face) {
        if (is_same(faces_[corner], tried)) continue;
        tried = faces_[corner];
        offer_side(tried);
      }
    }
  }
}

// Whether its bound may no longer hold since the last find_again().
bool Witnesses::is_touched(const Side& side, std::span<const std::uint8_t> has_changed) const {
  const auto [a, b, c] = side.face;
  return side.fails | was_sought_[side.from] | was_sought_[side.to] | has_changed[a] | has_changed[b] | has_changed[c];
}

// Both ends within the limit of one triangle: so is all of the side between them. Otherwise its middle needs one.
void Witnesses::find_for_sides(const Mesh& mesh, const Stars& stars, const DrawnSurface& drawn, float limit,
                               std::span<const std::uint8_t> has_changed) {
  const float most = limit * limit;
  if (has_changed.empty()) largest_side_square_ = 0;
  for (Side& side : sides_) {
    const auto [u, v] = std::pair(side.from, side.to);
    if (is_same(faces_[u], faces_[v])) continue;
    if (!has_changed.empty() && !is_touched(side, has_changed)) continue;
    const Vec3f middle = 0.5f * (drawn.positions[u] + drawn.positions[v]);
    const float weight = std::max(drawn.weights[u], drawn.weights[v]), scale = weight * weight;
    const float enough = most / scale;
    side.fails = false;
    side.square = squared_distance_to_image(drawn, middle, side.face);
    if (side.square > enough) improve_side(mesh, stars, drawn, side, enough);
    side.fails = side.square > enough;
    if (!side.fails) {
      largest_side_square_ = std::max(largest_side_square_, scale * side.square);
      continue;
    }
    for (const Index end : {u, v}) {
      if (squared_bounds_[end] <= most) failing_.push_back(end);
      squared_bounds_[end] = std::max(squared_bounds_[end], scale * side.square);
    }
  }
}

// Takes the image of the face for the witness of v if it is drawn and nearer.
bool Witnesses::offer(const DrawnSurface& drawn, Index v, const Triangle& face) {
  const float weight = drawn.weights[v];
  const float bound = weight * weight * squared_distance_to_image(drawn, drawn.positions[v], face);
  if (!(bound < squared_bounds_[v])) return false;
  squared_bounds_[v] = bound;
  faces_[v] = face;
  return true;
}

// Until one is within the limit. Neighbours often have the same witness, which is tried once.
bool Witnesses::improve(const Mesh& mesh, const Stars& stars, const DrawnSurface& drawn, Index v, float most) {
  bool better = false;
  Triangle tried = faces_[v];
  for (const Index number : stars.of(v)) {
    const Triangle& face = mesh.triangles[number];
    better |= offer(drawn, v, face);
    for (const Index corner : face) {
      if (squared_bounds_[v] <= most) return true;
      if (corner == v || is_same(faces_[corner], tried)) continue;
      tried = faces_[corner];
      better |= offer(drawn, v, tried);
    }
  }
  return better;
}

// Breadth first, from the vertices of triangles that are drawn.
void Witnesses::flood(const Mesh& mesh, const Stars& stars, const DrawnSurface& drawn) {
  queue_.clear();
  for (Index v = 0; v < faces_.size(); ++v) {
    squared_bounds_[v] = kInfinity;
    for (const Index face : stars.of(v)) offer(drawn, v, mesh.triangles[face]);
    if (squared_bounds_[v] < kInfinity) queue_.push_back(v);
  }
  for (std::size_t i = 0; i < queue_.size(); ++i) {
    const Index from = queue_[i];
    for (const Index face : stars.of(from)) {
      for (const Index to : mesh.triangles[face]) {
        if (squared_bounds_[to] < kInfinity || !offer(drawn, to, faces_[from])) continue;
        queue_.push_back(to);
      }
    }
  }
}

// Vertices beyond the limit are in failing_.
void Witnesses::settle(const Mesh& mesh, const Stars& stars, const DrawnSurface& drawn, float limit) {
  const float most = limit * limit;
  for (int sweep = 0; sweep < kSweeps && !failing_.empty(); ++sweep) {
    bool better = false;
    std::size_t kept = 0;
    for (const Index v : failing_) {
      better |= improve(mesh, stars, drawn, v, most);
      failing_[kept] = v;
      kept += squared_bounds_[v] > most;
    }
    failing_.resize(kept);
    if (!better) break;
  }
}

void Witnesses::find(const Mesh& mesh, const Stars& stars, const DrawnSurface& drawn, float limit) {
  assert(drawn.weights.size() == faces_.size() && limit >= 0);
  const float most = limit * limit;
  Index lost = 0;
  failing_.clear();
  for (Index v = 0; v < faces_.size(); ++v) {
    if (stars.of(v).empty()) continue;
    squared_bounds_[v] = kInfinity;
    if (offer(drawn, v, faces_[v]) && squared_bounds_[v] <= most) continue;
    lost += squared_bounds_[v] == kInfinity;
    failing_.push_back(v);
  }
  if (lost > faces_.size() / 8) {
    flood(mesh, stars, drawn);
    failing_.clear();
    for (Index v = 0; v < faces_.size(); ++v) {
      if (squared_bounds_[v] > most && !stars.of(v).empty()) failing_.push_back(v);
    }
  }
  settle(mesh, stars, drawn, limit);
}

void Witnesses::find_again(const Mesh& mesh, const Stars& stars, const DrawnSurface& drawn, float limit,
                           std::span<const std::uint8_t> has_changed) {
  const float most = limit * limit;
  failing_.clear();
  for (Index v = 0; v < faces_.size(); ++v) {
    const auto [a, b, c] = faces_[v];
    was_sought_[v] = (has_changed[a] | has_changed[b] | has_changed[c] | has_changed[v]) || squared_bounds_[v] > most;
    if (!was_sought_[v] || stars.of(v).empty()) continue;
    squared_bounds_[v] = kInfinity;
    if (!offer(drawn, v, faces_[v]) || squared_bounds_[v] > most) failing_.push_back(v);
  }
  settle(mesh, stars, drawn, limit);
}

}  // namespace limber
