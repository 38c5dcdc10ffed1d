// SPDX-License-Identifier: Apache-2.0
//   unfold(level):
//     for each triangle abc of the level that is turned over:
//       candidates: swaps out of the clusters a, b and c, and into them, that cost no more than `most` and either move
//       all of abc's minima to where it is not turned over, or a node where the three clusters meet, so that it ends
//       in order of cost, the first that is valid and leaves fewer triangles turned over around its two clusters: made
//
// A swap changes those triangles alone that have a corner in one of its clusters.
//
// Few triangles are turned over, and where nothing is done they stay so for many frames: one swap mends all of them, if
// it is not taken back because that lowers the error, which move() sees to.
#include "limber/hierarchy/unfold.h"

#include <algorithm>
#include <array>

#include "limber/base/facing.h"
#include "limber/base/triangles.h"

namespace limber {

bool Unfolder::is_over(Index a, Index b, Index c) const {
  Facing surface = clusters_.facing(a);
  surface += clusters_.facing(b);
  surface += clusters_.facing(c);
  return is_turned_over(clusters_.minimum_at(a), clusters_.minimum_at(b), clusters_.minimum_at(c), surface);
}

// The first of those around the node; kNone where there is none.
Index Unfolder::first_neighbour_in(const LevelGraph& graph, Index node, Index cluster) const {
  for (const Index n : graph.around(node))
    if (clusters_.parent(n) == cluster) return n;
  return kNone;
}

// Whether the node is in one of the triangle's clusters and beside both others.
bool Unfolder::is_corner(const LevelGraph& graph, Index node, const Triangle& triangle) const {
  const Index from = clusters_.parent(node);
  return std::ranges::find(triangle, from) != triangle.end() && std::ranges::all_of(triangle, [&](Index corner) {
           return corner == from || first_neighbour_in(graph, node, corner) != kNone;
         });
}

// Triangles with a corner at the cluster, and none at `except`.
Index Unfolder::count_turned_over(const LevelGraph& graph, Index cluster, Index except) const {
  Index count = 0;
  for (const Index child : clusters_.children().of(cluster)) {
    const StarKind star = graph.star_of(child);
    const auto around = graph.around(child);
    if (star == StarKind::kIrregular) continue;
    Index before = clusters_.parent(star == StarKind::kClosed ? around.back() : around.front());
    for (const Index n : around) {
      const Index a = before, b = before = clusters_.parent(n);
      if (a == b || a == cluster || b == cluster || a == except || b == except) continue;
      count += is_over(cluster, a, b);
    }
  }
  return count;
}

Index Unfolder::count_around(const LevelGraph& graph, Index a, Index b) const {
  return count_turned_over(graph, a, kNone) + count_turned_over(graph, b, a);
}

void Unfolder::consider(const LevelGraph& graph, Index node, Index to, const Triangle& triangle, double most) {
  const Index from = clusters_.parent(node);
  if (clusters_.has_one_child(from)) return;
  if (Worth::kLikely * (worth_.about_burden(clusters_.quadric(node), to) - worth_.about_release(node)) > most) return;
  if (!is_corner(graph, node, triangle)) {
    const Quadric& q = clusters_.quadric(node);
    std::array<Vec3d, 3> corners;
    Facing surface;
    for (std::size_t k = 0; k < 3; ++k) {
      const Index corner = triangle[k];
      surface += clusters_.facing(corner);
      if (corner == from) surface -= clusters_.facing(node);
      if (corner == to) surface += clusters_.facing(node);
      corners[k] = corner == from ? minimum(clusters_.quadric(from) - q).point
                   : corner == to ? minimum(clusters_.quadric(to) + q).point
                                  : clusters_.minimum_at(corner);
    }
    if (is_turned_over(corners[0], corners[1], corners[2], surface)) return;
  }
  const double cost = -worth_.of_swap(node, to);
  if (cost <= most) candidates_.push_back({cost, node, to});
}

// Each once: a pair of a node and a cluster is met at the first neighbour that the node has there.
void Unfolder::find_candidates(const LevelGraph& graph, const Triangle& triangle, double most) {
  candidates_.clear();
  for (const Index corner : triangle) {
    for (const Index child : clusters_.children().of(corner)) {
      for (const Index n : graph.around(child)) {
        const Index other = clusters_.parent(n);
        if (other == corner) continue;
        if (first_neighbour_in(graph, child, other) == n) consider(graph, child, other, triangle, most);
        if (std::ranges::find(triangle, other) == triangle.end() && first_neighbour_in(graph, n, corner) == child)
          consider(graph, n, corner, triangle, most);
      }
    }
  }
  std::sort(candidates_.begin(), candidates_.end(), [](const Candidate& a, const Candidate& b) {
    return a.cost != b.cost ? a.cost < b.cost : a.node != b.node ? a.node < b.node : a.to < b.to;
  });
}

// False, and all is as before, where that does not leave fewer triangles turned over around both clusters than `below`.
bool Unfolder::move_if_fewer(const LevelGraph& graph, Index node, Index to, Index below) {
  const Index from = clusters_.parent(node);
  budget_.keep();
  if (!budget_.move(clusters_, graph, node, to)) return false;
  if (count_around(graph, from, to) < below) return true;
  clusters_.move(node, from);
  budget_.undo();
  return false;
}

void Unfolder::turn_back(const LevelGraph& graph, const Triangle& triangle, double most) {
  find_candidates(graph, triangle, most);
  for (const auto& [cost, node, to] : candidates_) {
    if (!is_valid_(graph, node, to)) continue;
    const Index from = clusters_.parent(node);
    if (!move_if_fewer(graph, node, to, count_around(graph, from, to))) continue;
    left_[node] = from;
    return;
  }
}

bool Unfolder::move(const LevelGraph& graph, Index node, Index to) {
  if (left_[node] != to) return budget_.move(clusters_, graph, node, to);
  return move_if_fewer(graph, node, to, count_around(graph, clusters_.parent(node), to) + 1);
}

void Unfolder::unfold(const LevelGraph& graph, double most) {
  list_images(graph.triangles, clusters_.hierarchy().parent, triangles_);
  // One that has ended since is looked at in vain; one that has begun since is not turned over.
  for (const Triangle& t : triangles_)
    if (is_over(t[0], t[1], t[2])) turn_back(graph, t, most);
}

}  // namespace limber
