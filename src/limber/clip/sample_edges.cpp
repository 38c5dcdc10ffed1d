// SPDX-License-Identifier: Apache-2.0
#include "limber/clip/sample_edges.h"

#include <algorithm>

namespace limber {

EdgeMesh::EdgeMesh(const Mesh& mesh) : out_(mesh.vertex_count, kNone), vertex_count_(mesh.vertex_count) {
  struct Directed {
    Index low, high, half_edge;
  };
  std::vector<Directed> edges;
  edges.reserve(mesh.triangles.size() * 3);
  for (const Triangle& triangle : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Index a = triangle[i], b = triangle[(i + 1) % 3], h = static_cast<Index>(from_.size());
      from_.push_back(a);
      out_[a] = h;
      edges.push_back({std::min(a, b), std::max(a, b), h});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const Directed& p, const Directed& q) {
    if (p.low != q.low) return p.low < q.low;
    return p.high != q.high ? p.high < q.high : p.half_edge < q.half_edge;
  });
  twin_.resize(from_.size());
  for (std::size_t i = 0; i + 1 < edges.size(); i += 2) {
    assert(edges[i].low == edges[i + 1].low && edges[i].high == edges[i + 1].high);
    link(edges[i].half_edge, edges[i + 1].half_edge);
  }
}

bool EdgeMesh::has_edge(Index a, Index b) const {
  Index h = out_[a];
  do {
    if (to(h) == b) return true;
    h = turn(h);
  } while (h != out_[a]);
  return false;
}

int EdgeMesh::degree(Index v) const {
  int count = 0;
  Index h = out_[v];
  do {
    ++count;
    h = turn(h);
  } while (h != out_[v]);
  return count;
}

Index EdgeMesh::split(Index h) {
  const Index g = twin_[h], h1 = next(h), h2 = prev(h), g2 = prev(g);
  const Index b = to(h), c = from_[h2], d = from_[g2];
  const Index m = static_cast<Index>(out_.size());
  const Index beyond_h1 = twin_[h1], beyond_g2 = twin_[g2];
  const Index k = half_edge_count(), l = k + 3;
  from_.insert(from_.end(), {m, b, c, b, m, d});
  twin_.resize(from_.size());
  from_[h1] = m;
  from_[g] = m;
  link(k, l);
  link(k + 1, beyond_h1);
  link(k + 2, h1);
  link(l + 2, beyond_g2);
  link(l + 1, g2);
  out_[b] = k + 1;
  out_.push_back(h1);
  ++vertex_count_;
  return m;
}

bool EdgeMesh::can_flip(Index h) const {
  const Index c = from_[prev(h)], d = from_[prev(twin_[h])];
  return c != d && degree(from_[h]) > 3 && degree(to(h)) > 3 && !has_edge(c, d);
}

void EdgeMesh::flip(Index h) {
  assert(can_flip(h));
  const Index g = twin_[h], h1 = next(h), h2 = prev(h), g1 = next(g), g2 = prev(g);
  const Index a = from_[h], b = from_[g], c = from_[h2], d = from_[g2];
  const Index beyond_h1 = twin_[h1], beyond_h2 = twin_[h2], beyond_g1 = twin_[g1], beyond_g2 = twin_[g2];
  from_[h] = d, from_[h1] = c, from_[h2] = a;
  from_[g] = c, from_[g1] = d, from_[g2] = b;
  link(h1, beyond_h2);
  link(h2, beyond_g1);
  link(g1, beyond_g2);
  link(g2, beyond_h1);
  out_[a] = h2, out_[b] = g2, out_[c] = h1, out_[d] = g1;
}

bool EdgeMesh::can_collapse(Index h) const {
  const Index a = from_[h], b = to(h), c = from_[prev(h)], d = from_[prev(twin_[h])];
  if (c == d || degree(c) <= 3 || degree(d) <= 3) return false;
  // The link condition: a and b have no common neighbours but c and d.
  Index g = out_[a];
  do {
    const Index x = to(g);
    if (x != b && x != c && x != d && has_edge(x, b)) return false;
    g = turn(g);
  } while (g != out_[a]);
  return true;
}

void EdgeMesh::collapse(Index h) {
  assert(can_collapse(h));
  const Index g = twin_[h], a = from_[h], b = from_[g], c = from_[prev(h)], d = from_[prev(g)];
  const Index first = twin_[next(h)], second = twin_[prev(h)], third = twin_[next(g)], fourth = twin_[prev(g)];
  Index x = out_[a];
  do {
    const Index after = turn(x);
    from_[x] = b;
    x = after;
  } while (x != out_[a]);
  for (const Index dead : {h, next(h), prev(h), g, next(g), prev(g)}) from_[dead] = kNone;
  link(first, second);
  link(third, fourth);
  out_[a] = kNone;
  out_[b] = second;
  out_[c] = first;
  out_[d] = third;
  --vertex_count_;
}

Mesh EdgeMesh::compact(std::vector<Index>& kept) const {
  kept.clear();
  std::vector<Index> renumbered(out_.size(), kNone);
  for (Index v = 0; v < out_.size(); ++v) {
    if (out_[v] == kNone) continue;
    renumbered[v] = static_cast<Index>(kept.size());
    kept.push_back(v);
  }
  Mesh mesh{.vertex_count = static_cast<Index>(kept.size()), .triangles = {}};
  for (Index h = 0; h < from_.size(); h += 3) {
    if (!is_alive(h)) continue;
    mesh.triangles.push_back({renumbered[from_[h]], renumbered[from_[h + 1]], renumbered[from_[h + 2]]});
  }
  return mesh;
}

}  // namespace limber
