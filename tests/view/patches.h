// SPDX-License-Identifier: Apache-2.0
// Meshes, hierarchies made of breadth-first patches, and random swaps, for the tests of the player.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "limber/base/mesh.h"
#include "limber/base/vec.h"
#include "limber/hierarchy/hierarchy.h"
#include "limber/stream/frame_state.h"
#include "tests/support/grid.h"

namespace limber::test {

struct Surface {
  Mesh mesh;
  std::vector<Vec3f> positions;
};

// The same numbers everywhere.
class Random {
 public:
  explicit Random(std::uint32_t seed) : state_(seed * 2654435769u + 1) {}

  std::uint32_t below(std::uint32_t end) {
    state_ ^= state_ << 13, state_ ^= state_ >> 17, state_ ^= state_ << 5;
    return static_cast<std::uint32_t>((std::uint64_t{state_} * end) >> 32);
  }
  float unit() { return static_cast<float>(below(1u << 24)) / static_cast<float>(1u << 24); }

 private:
  std::uint32_t state_;
};

// A wavy sheet of columns x rows vertices, with a border.
inline Surface sheet(Index columns, Index rows) {
  Surface s;
  s.mesh = grid(columns, rows);
  for (Index y = 0; y < rows; ++y) {
    for (Index x = 0; x < columns; ++x) {
      const auto u = static_cast<float>(x), v = static_cast<float>(y);
      s.positions.push_back({u, v, std::sin(0.7f * u) + std::cos(0.3f * v * u)});
    }
  }
  return s;
}

// A closed torus of `around` x `along` vertices.
inline Surface torus(Index around, Index along) {
  Surface s;
  s.mesh.vertex_count = around * along;
  for (Index j = 0; j < along; ++j) {
    for (Index i = 0; i < around; ++i) {
      const float u = 6.2831853f * static_cast<float>(i) / static_cast<float>(around);
      const float v = 6.2831853f * static_cast<float>(j) / static_cast<float>(along);
      const float r = 3 + std::cos(u);
      s.positions.push_back({r * std::cos(v), r * std::sin(v), std::sin(u)});
      const Index ii = (i + 1) % around, jj = (j + 1) % along;
      const Index a = j * around + i, b = j * around + ii, c = jj * around + i, d = jj * around + ii;
      s.mesh.triangles.push_back({a, c, d});
      s.mesh.triangles.push_back({a, d, b});
    }
  }
  return s;
}

// Parents for `fine_count` nodes, numbered from 0: `coarse_count` patches grown side by side along `edges`; a node
// that no patch reaches goes to patch 0.
inline std::vector<Index> grow_patches(Index fine_count, Index coarse_count,
                                       const std::vector<std::pair<Index, Index>>& edges) {
  std::vector<std::vector<Index>> near(fine_count);
  for (const auto& [a, b] : edges) near[a].push_back(b), near[b].push_back(a);
  std::vector<Index> parent(fine_count, kNone), queue;
  for (Index c = 0; c < coarse_count; ++c) {
    const auto seed = static_cast<Index>(std::uint64_t{c} * fine_count / coarse_count);
    parent[seed] = c;
    queue.push_back(seed);
  }
  for (std::size_t i = 0; i < queue.size(); ++i) {
    for (const Index next : near[queue[i]]) {
      if (parent[next] != kNone) continue;
      parent[next] = parent[queue[i]];
      queue.push_back(next);
    }
  }
  for (Index& p : parent) p = p == kNone ? 0 : p;
  return parent;
}

// Sets positions and errors of all nodes from those of the finest vertices: the mean, and the quadric error of the
// planes of the triangles around the vertices of the cluster.
inline void place_nodes(const Mesh& mesh, FrameState& state) {
  const Hierarchy& h = state.hierarchy;
  state.positions.resize(h.node_count());
  state.errors.assign(h.node_count(), 0.0f);
  std::vector<Index> node(h.vertex_count());
  for (Index v = 0; v < h.vertex_count(); ++v) node[v] = v;
  for (Index level = 1; level < h.level_count(); ++level) {
    std::vector<Vec3d> sum(h.node_count());
    std::vector<double> count(h.node_count(), 0.0), error(h.node_count(), 0.0);
    for (Index v = 0; v < h.vertex_count(); ++v) {
      node[v] = h.parent[node[v]];
      sum[node[v]] += Vec3d(state.positions[v]);
      count[node[v]] += 1;
    }
    for (Index n = h.level_begin[level]; n < h.level_begin[level + 1]; ++n) {
      if (count[n] > 0) state.positions[n] = Vec3f(sum[n] * (1 / count[n]));
    }
    for (const Triangle& t : mesh.triangles) {
      const Vec3d a(state.positions[t[0]]), b(state.positions[t[1]]), c(state.positions[t[2]]);
      const Vec3d normal = cross(b - a, c - a);
      const double twice_area = length(normal);
      if (twice_area == 0) continue;
      for (const Index corner : t) {
        const double distance = dot(normal, Vec3d(state.positions[node[corner]]) - a) / twice_area;
        error[node[corner]] += twice_area / 6 * distance * distance;
      }
    }
    for (Index n = h.level_begin[level]; n < h.level_begin[level + 1]; ++n) {
      state.errors[n] = static_cast<float>(std::sqrt(error[n]));
    }
  }
}

// A hierarchy of these level sizes, finest first.
inline FrameState patch_state(const Surface& surface, const std::vector<Index>& level_sizes) {
  FrameState state;
  state.positions = surface.positions;
  std::vector<std::pair<Index, Index>> edges;
  for (const Triangle& t : surface.mesh.triangles) {
    for (int i = 0; i < 3; ++i)
      edges.push_back({t[static_cast<std::size_t>(i)], t[static_cast<std::size_t>(i + 1) % 3]});
  }
  Hierarchy& h = state.hierarchy;
  h.level_begin = {0};
  for (const Index size : level_sizes) h.level_begin.push_back(h.level_begin.back() + size);
  for (std::size_t level = 0; level + 1 < level_sizes.size(); ++level) {
    const std::vector<Index> parent = grow_patches(level_sizes[level], level_sizes[level + 1], edges);
    for (const Index p : parent) h.parent.push_back(h.level_begin[level + 1] + p);
    for (auto& [a, b] : edges) a = parent[a], b = parent[b];
  }
  h.parent.resize(h.node_count(), kNone);
  place_nodes(surface.mesh, state);
  return state;
}

// Moves up to `count` nodes, of random levels, to the cluster of a neighbour; no cluster is left empty. Errors change
// a little, as they do between frames. `state.swaps` becomes the moves.
inline void deform(const Mesh& mesh, FrameState& state, std::uint32_t count, Random& random) {
  Hierarchy& h = state.hierarchy;
  std::vector<Index> child_count(h.node_count(), 0);
  for (const Index p : h.parent) child_count[p == kNone ? 0 : p] += p != kNone;
  state.swaps.clear();
  for (std::uint32_t i = 0; i < count && h.level_count() > 1; ++i) {
    const Triangle& t = mesh.triangles[random.below(static_cast<std::uint32_t>(mesh.triangles.size()))];
    const Index corner = random.below(3);
    Index a = t[corner], b = t[(corner + 1) % 3];
    for (Index level = 0; level + 2 < h.level_count() && random.below(8) == 0; ++level)
      a = h.parent[a], b = h.parent[b];
    const Swap swap{a, h.parent[b]};
    if (h.parent[a] == swap.parent || child_count[h.parent[a]] < 2) continue;
    --child_count[h.parent[a]], ++child_count[swap.parent];
    apply(h, swap);
    state.swaps.push_back(swap);
  }
  for (Index n = h.vertex_count(); n < h.node_count(); ++n) state.errors[n] *= 0.95f + 0.1f * random.unit();
  ++state.frame;
}

}  // namespace limber::test
