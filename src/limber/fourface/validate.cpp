// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdint>
#include <unordered_map>

#include "limber/fourface/four_k_mesh.h"

namespace limber {
namespace {

// Edges of the current mesh, and in how many of its triangles each is.
class EdgeCounts {
 public:
  void add(const Triangle& t) {
    for (std::size_t i = 0; i < 3; ++i) ++counts_[key(t[i], t[(i + 1) % 3])];
  }
  void remove(const Triangle& t) {
    for (std::size_t i = 0; i < 3; ++i) --counts_[key(t[i], t[(i + 1) % 3])];
  }
  bool contains(Index a, Index b) const {
    const auto found = counts_.find(key(a, b));
    return found != counts_.end() && found->second > 0;
  }

 private:
  static std::uint64_t key(Index a, Index b) { return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b); }
  std::unordered_map<std::uint64_t, Index> counts_;
};

using DirectedEdge = std::pair<Index, Index>;

// The directed edges of triangles, less those that are there in both directions, sorted.
template <class Ids>
std::vector<DirectedEdge> boundary(const FourKMesh& mesh, const Ids& ids) {
  std::vector<DirectedEdge> edges;
  for (const Index t : ids) {
    const Triangle& corners = mesh.triangles[t];
    for (std::size_t i = 0; i < 3; ++i) {
      const DirectedEdge edge{corners[i], corners[(i + 1) % 3]};
      const auto back = std::find(edges.begin(), edges.end(), DirectedEdge{edge.second, edge.first});
      if (back != edges.end())
        edges.erase(back);
      else
        edges.push_back(edge);
    }
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

std::vector<Index> created_by(const FourKMesh& mesh, Index operation) {
  std::vector<Index> ids;
  for (Index t = mesh.created_begin[operation]; t < mesh.created_begin[operation + 1]; ++t) ids.push_back(t);
  return ids;
}

bool is_numbered(const FourKMesh& mesh) {
  const std::size_t operations = mesh.vertex.size(), triangles = mesh.triangles.size();
  if (mesh.creator.size() != triangles || mesh.destroyer.size() != triangles || mesh.finest_count > triangles ||
      mesh.error.size() != operations || mesh.radius.size() != operations ||
      mesh.created_begin.size() != operations + 1 || mesh.destroyed_begin.size() != operations + 1)
    return false;
  if (mesh.created_begin.front() != mesh.finest_count || mesh.created_begin.back() != triangles ||
      mesh.destroyed_begin.front() != 0 || mesh.destroyed_begin.back() != mesh.destroyed.size())
    return false;
  if (!std::is_sorted(mesh.created_begin.begin(), mesh.created_begin.end()) ||
      !std::is_sorted(mesh.destroyed_begin.begin(), mesh.destroyed_begin.end()) ||
      !std::is_sorted(mesh.level_begin.begin(), mesh.level_begin.end()))
    return false;
  const auto is_vertex = [&](Index v) { return v < mesh.vertex_count; };
  return std::all_of(mesh.vertex.begin(), mesh.vertex.end(), is_vertex) &&
         std::all_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const Triangle& t) {
           return !is_degenerate(t) && std::all_of(t.begin(), t.end(), is_vertex);
         });
}

bool are_arcs(const FourKMesh& mesh) {
  std::vector<Index> creator(mesh.triangle_count(), kNone), destroyer(mesh.triangle_count(), kNone);
  for (Index o = 0; o < mesh.operation_count(); ++o) {
    for (const Index t : mesh.destroyed_by(o)) {
      if (t >= mesh.created_begin[o] || destroyer[t] != kNone) return false;
      destroyer[t] = o;
    }
    for (const Index t : created_by(mesh, o)) creator[t] = o;
  }
  return creator == mesh.creator && destroyer == mesh.destroyer;
}

bool is_local(const FourKMesh& mesh, Index o) {
  const auto destroyed = mesh.destroyed_by(o);
  const std::vector<Index> created = created_by(mesh, o);
  const bool swap = destroyed.size() == 2 && created.size() == 2;
  const bool removal = (destroyed.size() == 4 && created.size() == 2) ||
                       (destroyed.size() == 3 && created.size() == 1) || (destroyed.size() == 2 && created.size() == 1);
  if (!swap && !removal) return false;
  const auto has_vertex = [&](Index t) {
    return std::find(mesh.triangles[t].begin(), mesh.triangles[t].end(), mesh.vertex[o]) != mesh.triangles[t].end();
  };
  if (!std::all_of(destroyed.begin(), destroyed.end(), has_vertex)) return false;
  if (removal && std::any_of(created.begin(), created.end(), has_vertex)) return false;
  std::vector<DirectedEdge> before = boundary(mesh, destroyed);
  if (removal && destroyed.size() == 2) {
    // At a border vertex the two border edges become one.
    const auto of_vertex = [&](const DirectedEdge& e) {
      return e.first == mesh.vertex[o] || e.second == mesh.vertex[o];
    };
    Index from = kNone, to = kNone;
    for (const DirectedEdge& e : before) {
      if (e.first == mesh.vertex[o]) to = e.second;
      if (e.second == mesh.vertex[o]) from = e.first;
    }
    std::erase_if(before, of_vertex);
    before.push_back({from, to});
    std::sort(before.begin(), before.end());
  }
  return before == boundary(mesh, created);
}

bool creates_new_edges(const FourKMesh& mesh) {
  EdgeCounts edges;
  for (Index t = 0; t < mesh.finest_count; ++t) edges.add(mesh.triangles[t]);
  for (Index o = 0; o < mesh.operation_count(); ++o) {
    const std::vector<Index> created = created_by(mesh, o);
    for (const Index t : created) {
      const Triangle& corners = mesh.triangles[t];
      for (std::size_t i = 0; i < 3; ++i) {
        const Index a = corners[i], b = corners[(i + 1) % 3];
        const bool old = std::ranges::any_of(mesh.destroyed_by(o), [&](Index d) {
          const Triangle& c = mesh.triangles[d];
          return std::ranges::find(c, a) != c.end() && std::ranges::find(c, b) != c.end();
        });
        if (!old && edges.contains(a, b)) return false;
      }
    }
    for (const Index t : mesh.destroyed_by(o)) edges.remove(mesh.triangles[t]);
    for (const Index t : created) edges.add(mesh.triangles[t]);
  }
  return true;
}

bool is_covered(const FourKMesh& mesh, std::span<const Vec3f> positions, Index o) {
  const auto center = static_cast<Vec3d>(positions[mesh.vertex[o]]);
  const auto radius = static_cast<double>(mesh.radius[o]);
  for (const Index t : mesh.destroyed_by(o)) {
    for (const Index corner : mesh.triangles[t])
      if (length(static_cast<Vec3d>(positions[corner]) - center) > radius) return false;
    const Index c = mesh.creator[t];
    if (c == kNone) continue;
    if (length(static_cast<Vec3d>(positions[mesh.vertex[c]]) - center) + static_cast<double>(mesh.radius[c]) > radius)
      return false;
  }
  return true;
}

}  // namespace

const char* validate(const FourKMesh& mesh, std::span<const Vec3f> positions) {
  if (!is_numbered(mesh)) return "operations-numbered";
  if (!are_arcs(mesh)) return "triangle-created-once";
  for (Index o = 0; o < mesh.operation_count(); ++o)
    if (!is_local(mesh, o)) return "operation-local";
  if (!creates_new_edges(mesh)) return "edge-created-once";
  for (Index o = 0; o < mesh.operation_count(); ++o) {
    for (const Index t : mesh.destroyed_by(o))
      if (mesh.creator[t] != kNone && !(mesh.error[mesh.creator[t]] <= mesh.error[o])) return "errors-monotone";
    if (!is_covered(mesh, positions, o)) return "spheres-nested";
  }
  return nullptr;
}

}  // namespace limber
