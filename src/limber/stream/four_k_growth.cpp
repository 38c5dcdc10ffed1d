// SPDX-License-Identifier: Apache-2.0
#include "limber/stream/four_k_growth.h"

#include <algorithm>
#include <cassert>

namespace limber {
namespace {

// Turns the triangle so that it begins with the corner.
void begin_with(Triangle& triangle, Index corner) {
  std::rotate(triangle.begin(), std::find(triangle.begin(), triangle.end(), corner), triangle.end());
}

Index corner_after(const Triangle& triangle, Index corner) {
  return triangle[0] == corner ? triangle[1] : triangle[1] == corner ? triangle[2] : triangle[0];
}

}  // namespace

Index FourKGrowth::add_vertex() {
  stars_.emplace_back();
  parents_.push_back({kNone, kNone, kNone, kNone});
  parent_count_.push_back(0);
  return vertex_count() - 1;
}

void FourKGrowth::add_coarsest(const Triangle& triangle) {
  assert(!is_degenerate(triangle) && operations_.empty());
  for (const Index corner : triangle) stars_[corner].push_back(triangle_count());
  triangles_.push_back(triangle);
}

// The triangle that passes the edge in this direction; kNone: there is none.
Index FourKGrowth::across(Index from, Index to) const {
  const std::vector<Index>& star = stars_[from].size() <= stars_[to].size() ? stars_[from] : stars_[to];
  for (const Index t : star) {
    const Triangle& corners = triangles_[t];
    if (std::find(corners.begin(), corners.end(), from) != corners.end() && corner_after(corners, from) == to) return t;
  }
  return kNone;
}

void FourKGrowth::add(Operation& operation, const Triangle& triangle) {
  for (const Index corner : triangle) stars_[corner].push_back(triangle_count());
  operation.fine[operation.fine_count++] = triangle_count();
  triangles_.push_back(triangle);
}

void FourKGrowth::remove(Index triangle) {
  for (const Index corner : triangles_[triangle]) {
    std::vector<Index>& star = stars_[corner];
    *std::find(star.begin(), star.end(), triangle) = star.back();
    star.pop_back();
  }
}

bool FourKGrowth::refine(Refinement kind, Index u, Index place, Index v) {
  assert(u < vertex_count() && v < vertex_count() && (kind == Refinement::kSwap) == (u == v));
  if (place >= stars_[u].size()) return false;
  Operation operation;
  operation.vertex = v;
  operation.coarse[operation.coarse_count++] = stars_[u][place];
  Triangle told = triangles_[stars_[u][place]];
  begin_with(told, u);
  const Index s = told[1], w = told[2];
  Index other = kNone;
  if (kind == Refinement::kFour || kind == Refinement::kSwap) {
    const Index beside = kind == Refinement::kFour ? across(u, w) : across(w, s);
    if (beside == kNone) return false;
    other = corner_after(triangles_[beside], kind == Refinement::kFour ? w : s);
    if (other == u || other == s) return false;
    operation.coarse[operation.coarse_count++] = beside;
  }
  if (kind == Refinement::kSwap && other == w) return false;
  triangles_[operation.coarse[0]] = told;
  if (operation.coarse_count == 2 && kind == Refinement::kFour) begin_with(triangles_[operation.coarse[1]], u);
  for (std::size_t i = 0; i < operation.coarse_count; ++i) remove(operation.coarse[i]);
  const auto set_parents = [&](std::initializer_list<Index> all) {
    std::copy(all.begin(), all.end(), parents_[v].begin());
    parent_count_[v] = static_cast<std::uint8_t>(all.size());
  };
  switch (kind) {
    case Refinement::kFour:
      add(operation, {v, u, s}), add(operation, {v, s, w}), add(operation, {v, w, other}),
          add(operation, {v, other, u});
      set_parents({u, s, w, other});
      break;
    case Refinement::kThree:
      add(operation, {v, u, s}), add(operation, {v, s, w}), add(operation, {v, w, u});
      set_parents({u, s, w});
      break;
    case Refinement::kBorderFirst:
      add(operation, {v, u, s}), add(operation, {v, s, w});
      set_parents({u, w});
      break;
    case Refinement::kBorderLast:
      add(operation, {v, s, w}), add(operation, {v, w, u});
      set_parents({u, s});
      break;
    case Refinement::kSwap:
      add(operation, {v, s, other}), add(operation, {v, other, w});
      break;
  }
  operations_.push_back(operation);
  return true;
}

FourKMesh FourKGrowth::assemble() const {
  FourKMesh mesh;
  mesh.vertex_count = vertex_count();
  const Index count = operation_count();
  // By the numbers that triangles have here.
  std::vector<Index> creator(triangles_.size(), kNone), place(triangles_.size());
  for (Index r = 0; r < count; ++r)
    for (std::size_t i = 0; i < operations_[r].coarse_count; ++i) creator[operations_[r].coarse[i]] = count - 1 - r;
  mesh.triangles.reserve(triangles_.size());
  const auto put = [&](Index t) {
    place[t] = mesh.triangle_count();
    mesh.triangles.push_back(triangles_[t]);
    mesh.creator.push_back(creator[t]);
  };
  for (Index t = 0; t < triangle_count(); ++t)
    if (creator[t] == kNone) put(t);
  mesh.finest_count = mesh.triangle_count();
  mesh.created_begin.push_back(mesh.finest_count);
  mesh.destroyed_begin.push_back(0);
  mesh.destroyer.assign(triangles_.size(), kNone);
  for (Index o = 0; o < count; ++o) {
    const Operation& operation = operations_[count - 1 - o];
    for (std::size_t i = 0; i < operation.coarse_count; ++i) put(operation.coarse[i]);
    for (std::size_t i = 0; i < operation.fine_count; ++i) {
      const Index t = place[operation.fine[i]];
      mesh.destroyed.push_back(t);
      mesh.destroyer[t] = o;
    }
    mesh.created_begin.push_back(mesh.triangle_count());
    mesh.destroyed_begin.push_back(static_cast<Index>(mesh.destroyed.size()));
    mesh.vertex.push_back(operation.vertex);
  }
  return mesh;
}

}  // namespace limber
