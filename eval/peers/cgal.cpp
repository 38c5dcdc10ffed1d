// SPDX-License-Identifier: Apache-2.0
// CGAL's Surface_mesh_simplification on every frame, with its own policies as its manual shows them: Lindstrom & Turk's
// (1998, 1999), which are its default, and the plane quadrics of Garland & Heckbert (1997).
//
//   frame:  fill a Surface_mesh (not timed), collapse edges until it is as small as asked for, and list what is left
//
// A visitor that hears of each collapse knows the clusters.
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Edge_collapse_visitor_base.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>
#ifdef LIMBER_CGAL_EIGEN
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/GarlandHeckbert_plane_policies.h>
#endif

#include <cassert>
#include <span>
#include <vector>

#include "eval/methods/thread_time.h"
#include "eval/peers/factories.h"

namespace limber::eval {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using HalfEdges = CGAL::Surface_mesh<Kernel::Point_3>;
using Vertex = HalfEdges::Vertex_index;
namespace sms = CGAL::Surface_mesh_simplification;

// Stops as soon as the surface is as small as asked for.
struct IsSmallEnough {
  Index vertices, triangles;  // one of them 0: any number

  template <class Cost, class Profile>
  bool operator()(const Cost&, const Profile& profile, std::size_t, std::size_t) const {
    const HalfEdges& surface = profile.surface_mesh();
    return vertices > 0 ? surface.number_of_vertices() <= vertices : surface.number_of_faces() <= triangles;
  }
};

// Remembers what became of every vertex. CGAL copies it: it refers.
struct Gather : sms::Edge_collapse_visitor_base<HalfEdges> {
  explicit Gather(std::vector<Vertex>& vertices) : into(&vertices) {}

  void OnCollapsed(const Profile& profile, const Vertex& kept) { (*into)[profile.v0()] = (*into)[profile.v1()] = kept; }

  std::vector<Vertex>* into;  // [vertex count]: the vertex that it is now part of, or itself
};

using Collapse = void (*)(HalfEdges& surface, const IsSmallEnough& stop, const Gather& visitor);

void collapse_lindstrom_turk(HalfEdges& surface, const IsSmallEnough& stop, const Gather& visitor) {
  sms::edge_collapse(surface, stop, CGAL::parameters::visitor(visitor));
}

#ifdef LIMBER_CGAL_EIGEN
void collapse_garland_heckbert(HalfEdges& surface, const IsSmallEnough& stop, const Gather& visitor) {
  const sms::GarlandHeckbert_plane_policies<HalfEdges, Kernel> quadrics(surface);
  sms::edge_collapse(
      surface, stop,
      CGAL::parameters::get_cost(quadrics.get_cost()).get_placement(quadrics.get_placement()).visitor(visitor));
}
#endif

class Cgal final : public Method {
 public:
  Cgal(const MethodOptions& options, Collapse collapse)
      : is_small_enough_{options.vertices, options.triangles}, collapse_(collapse) {}

  void begin(const Mesh& mesh, std::span<const std::span<const Vec3f>>) override {
    mesh_ = &mesh;
    place_.assign(mesh.vertex_count, kNone);
    used_.clear();
    for (const Triangle& triangle : mesh.triangles) {
      for (const Index vertex : triangle) {
        if (place_[vertex] != kNone) continue;
        place_[vertex] = static_cast<Index>(used_.size());
        used_.push_back(vertex);
      }
    }
  }

  void frame(std::span<const Vec3f> positions, Approximation& out) override {
    HalfEdges surface = fill(positions);
    std::vector<Vertex> into(surface.vertices().begin(), surface.vertices().end());
    const ThreadTimer adapting;
    collapse_(surface, is_small_enough_, Gather(into));
    out.adapt_seconds = adapting.seconds();

    const ThreadTimer extracting;
    list(surface, out);
    out.extract_seconds = extracting.seconds();
    gather(into, out);
  }

 private:
  HalfEdges fill(std::span<const Vec3f> positions) const {
    HalfEdges surface;
    surface.reserve(static_cast<Index>(used_.size()), static_cast<Index>(3 * mesh_->triangles.size() / 2),
                    static_cast<Index>(mesh_->triangles.size()));
    for (const Index vertex : used_) {
      const Vec3f& p = positions[vertex];
      surface.add_vertex(Kernel::Point_3(p.x, p.y, p.z));
    }
    for (const Triangle& t : mesh_->triangles) {
      [[maybe_unused]] const auto face =
          surface.add_face(Vertex(place_[t[0]]), Vertex(place_[t[1]]), Vertex(place_[t[2]]));
      assert(face != HalfEdges::null_face());  // check_oriented_manifold() said so
    }
    return surface;
  }

  void list(const HalfEdges& surface, Approximation& out) {
    out.positions.clear();
    out.nodes.clear();
    out.triangles.clear();
    listed_.resize(used_.size());
    for (const Vertex v : surface.vertices()) {
      const Kernel::Point_3& p = surface.point(v);
      listed_[v] = static_cast<Index>(out.nodes.size());
      out.nodes.push_back(used_[v]);
      out.positions.push_back(Vec3f(Vec3d{p.x(), p.y(), p.z()}));
    }
    for (const auto face : surface.faces()) {
      Triangle& triangle = out.triangles.emplace_back();
      std::size_t k = 0;
      for (const Vertex v : surface.vertices_around_face(surface.halfedge(face))) triangle[k++] = listed_[v];
    }
  }

  // Isolated vertices are clusters of their own.
  void gather(std::vector<Vertex>& into, Approximation& out) const {
    out.clusters.resize(mesh_->vertex_count);
    for (Index v = 0; v < mesh_->vertex_count; ++v) {
      out.clusters[v] = v;
      if (place_[v] == kNone) continue;
      Vertex now(place_[v]);
      while (into[now] != now) now = into[now] = into[into[now]];
      out.clusters[v] = used_[now];
    }
  }

  IsSmallEnough is_small_enough_;
  Collapse collapse_;
  const Mesh* mesh_ = nullptr;
  std::vector<Index> used_;    // the vertices that triangles use
  std::vector<Index> place_;   // [vertex_count]: where in used_, or kNone
  std::vector<Index> listed_;  // [used_.size()], scratch
};

}  // namespace

std::unique_ptr<Method> make_cgal_lindstrom_turk(const MethodOptions& options) {
  return std::make_unique<Cgal>(options, collapse_lindstrom_turk);
}

#ifdef LIMBER_CGAL_EIGEN
std::unique_ptr<Method> make_cgal_garland_heckbert(const MethodOptions& options) {
  return std::make_unique<Cgal>(options, collapse_garland_heckbert);
}
#endif

}  // namespace limber::eval
