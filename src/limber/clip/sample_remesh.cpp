// SPDX-License-Identifier: Apache-2.0
// Botsch & Kobbelt, "A remeshing approach to multiresolution modeling", SGP 2004, section 4:
//
//   repeat: split edges longer than 4/3 of the length wanted; collapse those shorter than 4/5;
//           flip; move each vertex towards the middle of its neighbours and back onto the surface
//
// Flips make the triangulation Delaunay instead of regular, the length wanted follows the body's sizes, and the last
// rounds split the longest or collapse the shortest edges until the vertex count is the one asked for.
#include <algorithm>
#include <cmath>

#include "limber/clip/sample_edges.h"
#include "limber/clip/sample_surface.h"

namespace limber {
namespace {

class Remesher {
 public:
  Remesher(const BodySurface& surface, const SurfaceMesh& start)
      : surface_(surface), edges_(start.mesh), positions_(start.positions), sizes_(start.positions.size()) {
    for (std::size_t v = 0; v < positions_.size(); ++v) place(static_cast<Index>(v), positions_[v]);
  }

  // The edge length, for a size of 1, at which the surface has so many vertices.
  double length_for(Index vertex_count) const {
    double area = 0.0;
    for (Index h = 0; h < edges_.half_edge_count(); h += 3) {
      if (!edges_.is_alive(h)) continue;
      const double size = (sizes_[edges_.from(h)] + sizes_[edges_.from(h + 1)] + sizes_[edges_.from(h + 2)]) / 3.0;
      area += 0.5 * length(normal(h)) / (size * size);
    }
    return std::sqrt(area / (0.8660254037844386 * vertex_count));
  }

  void split_long(double wanted) {
    const Index count = edges_.half_edge_count();
    for (Index h = 0; h < count; ++h) {
      if (edges_.is_alive(h) && relative_length(h) > wanted * (4.0 / 3.0)) split(h);
    }
  }

  void collapse_short(double wanted) {
    for (Index h = 0; h < edges_.half_edge_count(); ++h) {
      if (edges_.is_alive(h) && relative_length(h) < wanted * 0.8) collapse(h, wanted * (4.0 / 3.0), 0.3);
    }
  }

  void flip_to_delaunay() {
    for (int pass = 0; pass < 4; ++pass) {
      bool changed = false;
      for (Index h = 0; h < edges_.half_edge_count(); ++h) {
        if (!edges_.is_alive(h) || h > edges_.twin(h) || !flip_helps(h) || !edges_.can_flip(h)) continue;
        edges_.flip(h);
        changed = true;
      }
      if (!changed) break;
    }
  }

  void relax() {
    std::vector<Vec3d> sums(positions_.size());
    std::vector<double> weights(positions_.size(), 0.0);
    for (Index h = 0; h < edges_.half_edge_count(); h += 3) {
      if (!edges_.is_alive(h)) continue;
      const Index a = edges_.from(h), b = edges_.from(h + 1), c = edges_.from(h + 2);
      const double size = sizes_[a] + sizes_[b] + sizes_[c];
      const double weight = length(normal(h)) / (size * size);
      const Vec3d center = (positions_[a] + positions_[b] + positions_[c]) * (1.0 / 3.0);
      for (const Index v : {a, b, c}) sums[v] += center * weight, weights[v] += weight;
    }
    for (Index v = 0; v < edges_.vertex_slots(); ++v) {
      if (!edges_.is_alive_vertex(v) || !(weights[v] > 0.0)) continue;
      const Vec3d step = (sums[v] * (1.0 / weights[v]) - positions_[v]) * 0.7;
      const Vec3d up = surface_.body.at(positions_[v]).gradient;
      place(v, positions_[v] + step - up * (dot(up, step) / std::fmax(squared_length(up), 1e-12)));
    }
  }

  Index vertex_count() const { return edges_.vertex_count(); }

  // Splits or collapses as many edges as are missing or too many, the most fitting ones first.
  // Gives up, and returns false, where nothing more can be done.
  bool adjust(Index vertex_count) {
    double upright = 0.3;
    while (edges_.vertex_count() != vertex_count) {
      const bool split_edges = edges_.vertex_count() < vertex_count;
      struct Candidate {
        double order;
        Index h;
      };
      std::vector<Candidate> candidates;
      for (Index h = 0; h < edges_.half_edge_count(); ++h) {
        if (!edges_.is_alive(h) || h > edges_.twin(h)) continue;
        candidates.push_back({split_edges ? -relative_length(h) : relative_length(h), h});
      }
      std::sort(candidates.begin(), candidates.end(), [](const Candidate& p, const Candidate& q) {
        return p.order != q.order ? p.order < q.order : p.h < q.h;
      });
      const Index before = edges_.vertex_count();
      candidates.resize(std::min(candidates.size(), candidates.size() / 8 + 16));
      for (const Candidate& candidate : candidates) {
        if (edges_.vertex_count() == vertex_count) break;
        if (!edges_.is_alive(candidate.h)) continue;
        if (split_edges) {
          split(candidate.h);
        } else if (std::fabs(relative_length(candidate.h) - candidate.order) < 1e-12) {
          collapse(candidate.h, 1e9, upright);
        }
      }
      if (edges_.vertex_count() == before) {
        if (upright < -1.0) return false;
        upright -= 0.7;
      }
    }
    return true;
  }

  SurfaceMesh result() const {
    SurfaceMesh out;
    std::vector<Index> kept;
    out.mesh = edges_.compact(kept);
    for (const Index v : kept) out.positions.push_back(positions_[v]);
    return out;
  }

 private:
  void place(Index v, const Vec3d& point) {
    positions_[v] = surface_.project(point);
    sizes_[v] = surface_.body.at(positions_[v]).size;
  }

  Vec3d normal(Index h) const {
    const Vec3d& a = positions_[edges_.from(h)];
    return cross(positions_[edges_.to(h)] - a, positions_[edges_.from(EdgeMesh::prev(h))] - a);
  }

  double relative_length(Index h) const {
    const Index a = edges_.from(h), b = edges_.to(h);
    return length(positions_[b] - positions_[a]) * 2.0 / (sizes_[a] + sizes_[b]);
  }

  void split(Index h) {
    const Vec3d middle = (positions_[edges_.from(h)] + positions_[edges_.to(h)]) * 0.5;
    const Index m = edges_.split(h);
    positions_.push_back(middle);
    sizes_.push_back(1.0);
    place(m, middle);
  }

  // Would all triangles around from(h) but the two at the edge keep their side, and its edges stay short enough?
  bool star_allows(Index h, const Vec3d& point, double longest, double upright) const {
    const Index first = edges_.out(edges_.from(h));
    Index g = first;
    do {
      const Index x = edges_.to(g), y = edges_.from(EdgeMesh::prev(g));
      if (x != edges_.to(h) && length(positions_[x] - point) > longest * sizes_[x]) return false;
      if (x != edges_.to(h) && y != edges_.to(h)) {
        const Vec3d before = normal(g), after = cross(positions_[x] - point, positions_[y] - point);
        if (dot(before, after) < upright * length(before) * length(after)) return false;
      }
      g = edges_.turn(g);
    } while (g != first);
    return true;
  }

  void collapse(Index h, double longest, double upright) {
    if (!edges_.can_collapse(h)) return;
    const Vec3d middle = surface_.project((positions_[edges_.from(h)] + positions_[edges_.to(h)]) * 0.5);
    if (!star_allows(h, middle, longest, upright) || !star_allows(edges_.twin(h), middle, longest, upright)) return;
    const Index b = edges_.to(h);
    edges_.collapse(h);
    place(b, middle);
  }

  double cotangent(const Vec3d& apex, const Vec3d& p, const Vec3d& q) const {
    return dot(p - apex, q - apex) / std::fmax(length(cross(p - apex, q - apex)), 1e-30);
  }

  bool flip_helps(Index h) const {
    const Index g = edges_.twin(h);
    const Vec3d &a = positions_[edges_.from(h)], &b = positions_[edges_.to(h)];
    const Vec3d &c = positions_[edges_.from(EdgeMesh::prev(h))], &d = positions_[edges_.from(EdgeMesh::prev(g))];
    if (cotangent(c, a, b) + cotangent(d, a, b) > -1e-6) return false;
    const Vec3d up = normal(h) + normal(g), left = cross(d - a, c - a), right = cross(c - b, d - b);
    const double limit = 0.5 * length(up);
    return dot(up, left) > limit * length(left) && dot(up, right) > limit * length(right);
  }

  const BodySurface& surface_;
  EdgeMesh edges_;
  std::vector<Vec3d> positions_;  // [vertex_slots]
  std::vector<double> sizes_;     // [vertex_slots], the body's size at the vertex
};

}  // namespace

SurfaceMesh remesh(const BodySurface& surface, const SurfaceMesh& start, Index vertex_count) {
  Remesher remesher(surface, start);
  double correction = 1.0;
  for (int round = 0; round < 5; ++round) {
    const double wanted = remesher.length_for(vertex_count) * correction;
    remesher.split_long(wanted);
    remesher.collapse_short(wanted);
    remesher.flip_to_delaunay();
    remesher.relax();
    correction *= std::clamp(std::sqrt(remesher.vertex_count() / static_cast<double>(vertex_count)), 0.8, 1.25);
  }
  remesher.adjust(vertex_count);
  for (int round = 0; round < 4; ++round) {
    remesher.flip_to_delaunay();
    remesher.relax();
  }
  remesher.flip_to_delaunay();
  return remesher.result();
}

}  // namespace limber
