// SPDX-License-Identifier: Apache-2.0
// Velho 2001, "Algorithm"; docs/design.md, "Four-face clusters", says where this differs and why.
//
//   build_four_k(M):
//     a quadric for each vertex: its faces, and the lines through it              (start_quadrics, tag_edge)
//     for each level, until M is as small as asked for
//       no face is marked; C(v), at most E(v), of all vertices; a queue           (price_all)
//       take v, the cheapest, from the queue, until enough is done                (run_level)
//         plan its cluster as things are now; back into the queue if dearer
//         unless a face of v is marked                                            (simplify_cluster)
//           swap edges until v has four faces; remove v
//           mark the faces that are left of the four, not those that the swaps released
//           share Q_v out to u and w
//     errors and spheres that hold those of all operations below                  (make_monotone)
#include "limber/fourface/build_four_k.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>
#include <thread>

#include "limber/contract/cost_queue.h"
#include "limber/contract/edges.h"
#include "limber/contract/fetch.h"
#include "limber/contract/orientation.h"
#include "limber/contract/spatial_order.h"

namespace limber {
namespace {

constexpr float kNever = std::numeric_limits<float>::infinity();

// Calls body(first, end) for ranges that cover 0 .. count once, on so many threads.
template <class Body>
void for_ranges(Index count, unsigned threads, const Body& body) {
  constexpr Index kGrain = 1024;
  std::atomic<Index> next{0};
  const auto work = [&] {
    for (Index first; (first = next.fetch_add(kGrain, std::memory_order_relaxed)) < count;)
      body(first, std::min(first + kGrain, count));
  };
  std::vector<std::thread> others;
  for (unsigned i = 1; i < threads && i * kGrain < count; ++i) others.emplace_back(work);
  work();
  for (std::thread& other : others) other.join();
}

class Builder {
 public:
  // mesh: its vertices in spatial order, as `positions`, which are normalized.
  Builder(const Mesh& mesh, std::vector<Vec3d> positions, const FourKOptions& options)
      : options_(options),
        faces_(mesh),
        positions_(std::move(positions)),
        quadrics_(mesh.vertex_count),
        kept_(mesh.vertex_count, 0),
        marks_(mesh.vertex_count, 0),
        own_error_(mesh.vertex_count),
        plans_(mesh.vertex_count),
        planned_(mesh.vertex_count, 0),
        kept_error_(mesh.vertex_count) {
    start_quadrics(mesh);
    out_.vertex_count = mesh.vertex_count;
    out_.finest_count = faces_.face_count();
    out_.triangles.reserve(5 * std::size_t{out_.finest_count});
    out_.creator.reserve(5 * std::size_t{out_.finest_count});
    out_.destroyer.reserve(5 * std::size_t{out_.finest_count});
    for (const Triangle& t : mesh.triangles)
      if (!is_degenerate(t)) out_.triangles.push_back(t);
    out_.creator.assign(out_.finest_count, kNone);
    out_.destroyer.assign(out_.finest_count, kNone);
    out_.created_begin.push_back(out_.finest_count);
    out_.destroyed_begin.push_back(0);
    for (Index v = 0; v < mesh.vertex_count; ++v)
      if (faces_.outgoing(v) != kNone) ++vertices_left_;
  }

  bool has_turned_edges() const { return faces_.has_turned_edges(); }

  void keep(Index v) { kept_[v] = 1; }
  void tag_edge(Index a, Index b);

  FourKMesh run(const GoOnFunction& go_on);

 private:
  void start_quadrics(const Mesh& mesh);
  bool is_small_enough() const {
    return vertices_left_ <= options_.vertices || faces_.face_count() <= options_.triangles;
  }
  unsigned depth_of(const Star& star) const;
  float least_cost(Index v) const;
  bool is_current(Index v, const Star& star) const;
  bool plan(Index v, const Star& star, bool check_edges);
  void price_all();
  void fetch_ahead(const CostQueue& queue) const;
  void run_level(const GoOnFunction& go_on);
  void simplify_cluster(Star& star, const ClusterPlan& plan);
  Index triangle_of(Index half_edge) const { return faces_.face(FaceTable::face_of(half_edge)).triangle; }
  void swap_edge(Star& star, std::uint32_t place, unsigned depth);
  double swap_error(Index v, Index r, Index s, Index t) const;
  double removal_error(Index v, Index u) const;
  void add_quadric(Index v, const Quadric& quadric);
  void share_quadric(Index v, Index u, Index w);
  void record(Index v, double error, std::span<const Index> destroyed, std::span<const Index> created_faces,
              unsigned depth);
  ClusterInput input() const { return {faces_, positions_, quadrics_, own_error_}; }

  FourKOptions options_;
  FaceTable faces_;
  std::vector<Vec3d> positions_;
  std::vector<Quadric> quadrics_;
  std::vector<std::uint8_t> kept_;     // [vertex_count]: tagged
  std::vector<std::uint8_t> marks_;    // [vertex_count]: the last level in which it became a corner of a marked face
  std::vector<double> own_error_;      // [vertex_count]: Q_v(v)
  std::vector<ClusterPlan> plans_;     // [vertex_count]: until there is a plan its cost is at most that of one
  std::vector<std::uint8_t> planned_;  // [vertex_count]: the level of the plan; 0 where the star has changed since
  std::vector<double> kept_error_;     // [vertex_count]: Q_u(u) as it was planned with
  std::uint8_t level_ = 0;             // the mark of this level, from 1
  unsigned most_depth_ = 0;            // of clusters in this level
  Index vertices_left_ = 0;
  FourKMesh out_;
};

void Builder::start_quadrics(const Mesh& mesh) {
  VertexQuadrics(mesh, options_.quadrics).compute(positions_, quadrics_);
  for (Index v = 0; v < mesh.vertex_count; ++v) own_error_[v] = quadrics_[v](positions_[v]);
}

// The planes that stand on the edge, at right angles to its faces, hold a line in place as they do a border.
void Builder::tag_edge(Index a, Index b) {
  const Index edge = faces_.tag_edge(a, b);
  if (edge == kNone) return;
  for (const Index h : {edge, faces_.twin(edge)}) {
    const Vec3d from = positions_[faces_.origin(h)], along = positions_[faces_.target(h)] - from;
    const Vec3d across = cross(along, cross(along, positions_[faces_.origin(FaceTable::previous(h))] - from));
    const double size = length(across);
    if (!(size > 0)) continue;
    const double weight = 0.5 * options_.quadrics.border_weight * squared_length(along);
    const Quadric plane = Quadric::plane(across * (1 / size), from, weight);
    add_quadric(a, plane), add_quadric(b, plane);
  }
}

unsigned Builder::depth_of(const Star& star) const {
  unsigned depth = 0;
  for (std::uint32_t i = 0; i < star.face_count(); ++i)
    depth = std::max<unsigned>(depth, faces_.face(FaceTable::face_of(star.spoke[i])).depth);
  return depth + 1;
}

// At most E(v): C(v) alone, which needs no plan; kNever where v stays.
float Builder::least_cost(Index v) const {
  const Index start = faces_.outgoing(v);
  if (start == kNone || kept_[v] || faces_.is_complex(v)) return kNever;
  const Quadric& own = quadrics_[v];
  double least = kNever;
  const auto look_at = [&](Index u) { least = std::min(least, own(positions_[u]) + own_error_[u]); };
  Index h = start;
  do {
    look_at(faces_.target(h));
    const Index back = FaceTable::previous(h);
    h = faces_.twin(back);
    if (h == kNone) look_at(faces_.origin(back));
  } while (h != start && h != kNone);
  if (h == kNone) {
    for (h = faces_.twin(start); h != kNone; h = faces_.twin(h)) {
      h = FaceTable::next(h);
      look_at(faces_.target(h));
    }
  }
  return static_cast<float>(options_.cluster.removal_weight * std::max(least, 0.0));
}

void Builder::price_all() {
  for_ranges(faces_.vertex_count(), options_.threads, [&](Index first, Index end) {
    for (Index v = first; v < end; ++v) plans_[v].cost = least_cost(v);
  });
}

// Vertices come in an order that has nothing to do with where they lie.
void Builder::fetch_ahead(const CostQueue& queue) const {
  if (const Index v = queue.upcoming(12); v != kNone) {
    faces_.fetch_vertex(v);
    fetch(&marks_[v]);
    fetch(&plans_[v]);
  }
  if (const Index v = queue.upcoming(8); v != kNone && marks_[v] != level_) {
    faces_.fetch_face(v);
    fetch(&quadrics_[v]);
    fetch(&quadrics_[v].c);
  }
  if (const Index v = queue.upcoming(4); v != kNone && marks_[v] != level_)
    faces_.fetch_faces(v, [this](Index u) { fetch(&positions_[u]), fetch(&own_error_[u]); });
}

void Builder::run_level(const GoOnFunction& go_on) {
  const auto enough = static_cast<Index>(options_.level_share * faces_.face_count());
  // What rounding leaves of an error of 0, for quadrics of unit size.
  constexpr float kNothing = 1e-18f;
  CostQueue queue(vertices_left_);
  for (Index v = 0; v < faces_.vertex_count(); ++v)
    if (faces_.outgoing(v) != kNone && plans_[v].cost < kNever) queue.push(v, plans_[v].cost);
  Index steps = 0;
  while (!is_small_enough() && queue.advance([](Index, float cost) { return cost; })) {
    if (go_on && ++steps % 1024 == 0 && !go_on()) return;
    const Index v = queue.front();
    queue.pop();
    fetch_ahead(queue);
    const float was = plans_[v].cost;
    if (was > kNothing && faces_.face_count() <= enough) return;
    if (marks_[v] == level_) continue;
    Star star;
    if (!faces_.gather(v, star) || depth_of(star) > most_depth_) continue;
    bool found = is_current(v, star) || plan(v, star, false);
    if (found && plans_[v].cost <= was && !creates_new_edges(faces_, star, plans_[v])) found = plan(v, star, true);
    if (!found) continue;
    if (plans_[v].cost > was)
      queue.push(v, plans_[v].cost);
    else
      simplify_cluster(star, plans_[v]);
  }
}

// The quadrics of the other neighbours only grow, which makes the one that is kept no worse beside them.
bool Builder::is_current(Index v, const Star& star) const {
  return planned_[v] == level_ && kept_error_[v] == own_error_[star.ring[plans_[v].kept]];
}

bool Builder::plan(Index v, const Star& star, bool check_edges) {
  if (!plan_cluster(input(), star, options_.cluster, check_edges, plans_[v])) return false;
  planned_[v] = level_;
  kept_error_[v] = own_error_[star.ring[plans_[v].kept]];
  return true;
}

void Builder::record(Index v, double error, std::span<const Index> destroyed, std::span<const Index> created_faces,
                     unsigned depth) {
  const Index operation = out_.operation_count();
  for (const Index t : destroyed) out_.destroyer[t] = operation;
  out_.destroyed.insert(out_.destroyed.end(), destroyed.begin(), destroyed.end());
  for (const Index f : created_faces) {
    Face& face = faces_.face(f);
    face.triangle = out_.triangle_count();
    face.depth = static_cast<std::uint16_t>(depth);
    out_.triangles.push_back(face.corners);
    out_.creator.push_back(operation);
    out_.destroyer.push_back(kNone);
  }
  out_.created_begin.push_back(out_.triangle_count());
  out_.destroyed_begin.push_back(static_cast<Index>(out_.destroyed.size()));
  out_.vertex.push_back(v);
  out_.error.push_back(static_cast<float>(error));
}

// How far apart the diagonals of the quad are.
double Builder::swap_error(Index v, Index r, Index s, Index t) const {
  const Vec3d across = cross(positions_[r] - positions_[v], positions_[t] - positions_[s]);
  const double size = length(across);
  return size > 0 ? std::fabs(dot(positions_[s] - positions_[v], across)) / size : 0;
}

// How far u is, as the root of the mean square, from the planes that v stands for.
double Builder::removal_error(Index v, Index u) const {
  const Quadric& q = quadrics_[v];
  const double weight = q.trace();
  return weight > 0 ? std::sqrt(std::max(q(positions_[u]), 0.0) / weight) : 0;
}

void Builder::swap_edge(Star& star, std::uint32_t place, unsigned depth) {
  const std::uint32_t before = place == 0 ? star.count - 1 : place - 1, after = place + 1 == star.count ? 0 : place + 1;
  const std::array<Index, 2> destroyed{triangle_of(star.spoke[before]), triangle_of(star.spoke[place])};
  const double error = swap_error(star.center, star.ring[place], star.ring[before], star.ring[after]);
  record(star.center, error, destroyed, faces_.swap(star, place), depth);
}

void Builder::add_quadric(Index v, const Quadric& quadric) {
  quadrics_[v] += quadric;
  own_error_[v] = quadrics_[v](positions_[v]);
}

void Builder::share_quadric(Index v, Index u, Index w) {
  const Quadric& qv = quadrics_[v];
  const double cu = std::max(qv(positions_[u]) + own_error_[u], 0.0);
  const double cw = std::max(qv(positions_[w]) + own_error_[w], 0.0);
  const double share = cu + cw > 0 ? 1 - cu / (cu + cw) : 0.5;
  Quadric to_u = qv, to_w = qv;
  to_u *= share, to_w *= 1 - share;
  add_quadric(u, to_u), add_quadric(w, to_w);
}

void Builder::simplify_cluster(Star& star, const ClusterPlan& plan) {
  const unsigned depth = depth_of(star);
  const Index v = star.center, u = star.ring[plan.kept], w = star.ring[plan.opposite];
  const double error = removal_error(v, u);
  std::array<Index, ClusterPlan::kMostSwaps> swapped;
  for (std::uint32_t i = 0; i < plan.swap_count; ++i) swapped[i] = star.ring[plan.swaps[i]];
  for (std::uint32_t i = 0; i < plan.swap_count; ++i) swap_edge(star, star.place_of(swapped[i]), depth);

  std::array<Index, 4> destroyed{};
  for (std::uint32_t i = 0; i < star.face_count(); ++i) destroyed[i] = triangle_of(star.spoke[i]);
  std::array<Index, 2> left{};
  std::size_t left_count = 1;
  if (star.closed && star.count == 4) {
    const std::uint32_t first = star.place_of(u);
    left = faces_.remove_between_four(star, first, faces_.is_line(star.spoke[first]));
    left_count = 2;
  } else {
    left[0] = faces_.remove_between_three(star);
  }
  record(v, error, std::span(destroyed).first(star.face_count()), std::span(left).first(left_count), depth);
  Triangle& created = out_.triangles[out_.created_begin[out_.operation_count() - 1]];
  std::rotate(created.begin(), std::find(created.begin(), created.end(), u), created.end());
  for (std::uint32_t i = 0; i < star.count; ++i) marks_[star.ring[i]] = level_;
  for (std::uint32_t i = 0; i < plan.swap_count; ++i) planned_[swapped[i]] = 0;
  --vertices_left_;
  if (u != w)
    share_quadric(v, u, w);
  else
    add_quadric(u, quadrics_[v]);
}

FourKMesh Builder::run(const GoOnFunction& go_on) {
  out_.level_begin.push_back(0);
  const Index levels = std::min(options_.levels, Index{250});
  while (out_.level_count() < levels && level_ < 250 && !is_small_enough() && !(go_on && !go_on())) {
    ++level_;
    most_depth_ = static_cast<unsigned>(std::floor(std::max(options_.clusters_per_level, 1.0) * level_));
    price_all();
    run_level(go_on);
    if (out_.operation_count() > out_.level_begin.back()) {
      out_.level_begin.push_back(out_.operation_count());
    } else if (options_.may_fold && options_.cluster.fold_over_cosine > -1) {
      options_.cluster.fold_over_cosine = -2;
    } else {
      break;
    }
  }
  return std::move(out_);
}

// Errors and spheres of operations cover those of what they depend on, which comes before them.
void make_monotone(FourKMesh& mesh, std::span<const Vec3f> positions, double scale) {
  // More than what rounding does to distances between spheres.
  constexpr double kMargin = 1 + 1e-5;
  mesh.radius.resize(mesh.operation_count());
  for (Index o = 0; o < mesh.operation_count(); ++o) {
    const auto center = static_cast<Vec3d>(positions[mesh.vertex[o]]);
    float error = static_cast<float>(mesh.error[o] / scale);
    double radius = 0;
    for (const Index t : mesh.destroyed_by(o)) {
      for (const Index corner : mesh.triangles[t])
        radius = std::max(radius, length(static_cast<Vec3d>(positions[corner]) - center));
      const Index c = mesh.creator[t];
      if (c == kNone) continue;
      error = std::max(error, mesh.error[c]);
      const double apart = length(static_cast<Vec3d>(positions[mesh.vertex[c]]) - center);
      radius = std::max(radius, apart + static_cast<double>(mesh.radius[c]));
    }
    mesh.error[o] = error;
    mesh.radius[o] = static_cast<float>(radius * kMargin);
  }
}

}  // namespace

FourKMesh build_four_k(const Mesh& mesh, std::span<const Vec3f> positions, const FourKOptions& options,
                       const FourKTags& tags, GoOnFunction go_on) {
  assert(positions.size() == mesh.vertex_count && options.threads >= 1);
  const SpatialMesh placed = in_spatial_order(mesh, positions);
  const Normalization normalize = normalization(positions);
  const auto unit_positions = [&] {
    std::vector<Vec3d> all(mesh.vertex_count);
    for (Index i = 0; i < mesh.vertex_count; ++i) all[i] = normalize.to_unit(positions[placed.order[i]]);
    return all;
  };
  std::optional<Builder> builder(std::in_place, placed.mesh, unit_positions(), options);
  if (builder->has_turned_edges()) {
    Mesh alike = placed.mesh;
    orient_alike(alike);
    builder.emplace(alike, unit_positions(), options);
  }
  for (const Index v : tags.vertices) builder->keep(placed.places[v]);
  for (const auto& [a, b] : tags.edges) builder->tag_edge(placed.places[a], placed.places[b]);
  FourKMesh made = builder->run(go_on);
  for (Triangle& t : made.triangles)
    for (Index& corner : t) corner = placed.order[corner];
  for (Index& v : made.vertex) v = placed.order[v];
  make_monotone(made, positions, normalize.scale);
  return made;
}

}  // namespace limber
