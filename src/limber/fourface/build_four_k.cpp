// SPDX-License-Identifier: Apache-2.0
// Velho 2001, "Algorithm"; docs/design.md, "Four-face clusters", says where this differs and why.
//
//   build_four_k(M):
//     a quadric for each vertex: its faces, and the lines through it              (VertexErrors, tag_edge)
//     for each level, until M is as small as asked for
//       no face is marked; what E(v) is likely to be, of all vertices; a queue    (price_all)
//       take v, the cheapest, from the queue, until enough is done                (run_level)
//         plan its cluster as things are now, dearer if the chain below is long   (plan)
//         back into the queue if it has become dearer
//         unless a face of v is marked                                            (simplify_cluster)
//           swap edges until v has four faces; remove v
//           mark the faces that are left of the four, not those that the swaps released
//           share Q_v out to u and w
//     errors and spheres that hold those of all operations below                  (make_monotone)
#include "limber/fourface/build_four_k.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "limber/base/portable_math.h"
#include "limber/contract/cost_queue.h"
#include "limber/contract/fetch.h"
#include "limber/contract/orientation.h"
#include "limber/contract/spatial_order.h"
#include "limber/fourface/for_ranges.h"
#include "limber/fourface/record.h"
#include "limber/fourface/vertex_errors.h"

namespace limber {
namespace {

constexpr float kNever = std::numeric_limits<float>::infinity();

// Chains that grow evenly to this share of the height that they may have, and this number of operations, cost nothing.
constexpr double kEvenShare = .8;
constexpr double kEvenStart = 8;

double log2_of(Index n) { return portable_log(n) * 1.4426950408889634; }

class Builder {
 public:
  // mesh: its vertices in spatial order, as `positions`, which are as VertexErrors wants them.
  Builder(const Mesh& mesh, std::vector<Vec3d> positions, std::size_t frame_count, const FourKOptions& options)
      : options_(options),
        faces_(mesh),
        errors_(mesh, std::move(positions), frame_count, options.quadrics, faces_.is_closed()),
        kept_(mesh.vertex_count, 0),
        marks_(mesh.vertex_count, 0),
        plans_(mesh.vertex_count),
        planned_(mesh.vertex_count, 0),
        shared_(mesh.vertex_count, 0),
        record_(mesh, faces_) {
    if (frame_count > 1)
      options_.cluster.fold_over_cosine = std::min(options_.cluster.fold_over_cosine, options_.many_fold_over_cosine);
    for (Index v = 0; v < mesh.vertex_count; ++v)
      if (faces_.outgoing(v) != kNone) left_.push_back(v);
    vertices_left_ = static_cast<Index>(left_.size());
  }

  bool has_turned_edges() const { return faces_.has_turned_edges(); }

  void keep(Index v) { kept_[v] = 1; }
  void tag_edge(Index a, Index b) {
    if (const Index edge = faces_.tag_edge(a, b); edge != kNone) errors_.hold_line(faces_, edge);
  }

  FourKMesh run(const GoOnFunction& go_on);

 private:
  static constexpr unsigned kAny = 0xffff;  // what a face can count

  bool is_small_enough() const {
    return vertices_left_ <= options_.vertices || faces_.face_count() <= options_.triangles;
  }
  unsigned depth_of(const Star& star) const;
  unsigned operations_at(Index half_edge) const { return faces_.face(FaceTable::face_of(half_edge)).operations; }
  unsigned operations_below(const Star& star) const;
  bool is_current(Index v) const { return planned_[v] == level_ && shared_[plans_[v].kept_vertex] != level_; }
  bool plan(Index v, const Star& star);
  void limit_operations();
  double removal_cost(Index v) const;
  double likely_share();
  void price_all();
  void fetch_ahead(const CostQueue& queue) const;
  void run_level(const GoOnFunction& go_on);
  void simplify_cluster(Star& star, const ClusterPlan& plan);
  Index triangle_of(Index half_edge) const { return faces_.face(FaceTable::face_of(half_edge)).triangle; }
  void swap_edge(Star& star, std::uint32_t place, unsigned depth);
  void remove_vertex(const Star& star, Index u, double error, unsigned depth);

  FourKOptions options_;
  FaceTable faces_;
  VertexErrors errors_;
  std::vector<std::uint8_t> kept_;     // [vertex_count]: tagged
  std::vector<std::uint8_t> marks_;    // [vertex_count]: the last level in which it became a corner of a marked face
  std::vector<Index> left_;            // [vertices_left_ when the level began]: those that have faces
  std::vector<ClusterPlan> plans_;     // [vertex_count]: until there is a plan its cost is what that is likely to be
  std::vector<std::uint8_t> planned_;  // [vertex_count]: the level of the plan; 0 where the star has changed since
  std::vector<std::uint8_t> shared_;   // [vertex_count]: the last level in which it was given a share of a quadric
  std::uint8_t level_ = 0;             // the mark of this level, from 1
  unsigned most_depth_ = 0;            // of clusters in this level
  unsigned most_operations_ = kAny;    // in a row, with those of the cluster itself
  unsigned even_operations_ = kAny;    // more than that, in this level, make a cluster dearer
  Index vertices_left_ = 0;
  Record record_;
};

unsigned Builder::depth_of(const Star& star) const {
  unsigned depth = 0;
  for (std::uint32_t i = 0; i < star.face_count(); ++i)
    depth = std::max<unsigned>(depth, faces_.face(FaceTable::face_of(star.spoke[i])).depth);
  return depth + 1;
}

unsigned Builder::operations_below(const Star& star) const {
  unsigned most = 0;
  for (std::uint32_t i = 0; i < star.face_count(); ++i) most = std::max(most, operations_at(star.spoke[i]));
  return most;
}

// C(v), which needs no plan; kNever where v stays.
double Builder::removal_cost(Index v) const {
  if (kept_[v]) return kNever;
  return options_.cluster.removal_weight * errors_.least_removal(faces_, v);
}

// What E(v) has beside C(v) is about a share of the square of the area that v stands for: less than what it is in the
// middle of some plans, so that few cost less than they are taken for. Where few are left, all are planned in the order
// of what they cost at least.
double Builder::likely_share() {
  constexpr std::size_t kSome = 256, kFew = 4096;
  constexpr double kOfMiddle = .7;
  if (left_.size() < kFew) return 0;
  std::vector<double> shares;
  Star star;
  for (std::size_t i = 0; i < left_.size(); i += left_.size() / kSome) {
    const Index v = left_[i];
    const double removal = removal_cost(v), squares = errors_.squared_weight(v);
    if (removal < kNever && squares > 0 && faces_.gather(v, star) && plan(v, star))
      shares.push_back((static_cast<double>(plans_[v].cost) - removal) / squares);
    planned_[v] = 0;
  }
  if (shares.empty()) return 0;
  const auto middle = shares.begin() + static_cast<std::ptrdiff_t>(shares.size() / 2);
  std::nth_element(shares.begin(), middle, shares.end());
  return std::max(*middle, 0.0) * kOfMiddle;
}

void Builder::price_all() {
  constexpr unsigned kOld = 4;
  if (level_ % kOld == 0) faces_.forget_old_edges();
  std::erase_if(left_, [this](Index v) { return faces_.outgoing(v) == kNone; });
  const double share = likely_share();
  for_ranges(static_cast<Index>(left_.size()), options_.threads, [this, share](Index first, Index end) {
    for (Index i = first; i < end; ++i) {
      const Index v = left_[i];
      if (i + 12 < end) faces_.fetch_vertex(left_[i + 12]);
      if (i + 8 < end) faces_.fetch_face(left_[i + 8]), errors_.fetch_quadric(left_[i + 8]);
      if (i + 4 < end) faces_.fetch_faces(left_[i + 4], 1, [](Index) {});
      plans_[v].cost = static_cast<float>(removal_cost(v) + share * errors_.squared_weight(v));
    }
  });
}

// Vertices come in an order that has nothing to do with where they lie.
void Builder::fetch_ahead(const CostQueue& queue) const {
  if (const Index v = queue.upcoming(16); v != kNone) {
    faces_.fetch_vertex(v);
    fetch(&marks_[v]);
    fetch(&plans_[v]);
  }
  const auto next = [&](std::size_t ahead, const auto& ask_for) {
    if (const Index v = queue.upcoming(ahead); v != kNone && marks_[v] != level_) ask_for(v);
  };
  next(13, [this](Index v) {
    faces_.fetch_face(v);
    errors_.fetch_quadric(v);
  });
  const auto faces = [&](int steps) {
    return [this, steps](Index v) {
      faces_.fetch_faces(v, steps, [this](Index u) { faces_.fetch_vertex(u), errors_.fetch_position(u); });
    };
  };
  next(10, faces(1));
  next(7, faces(2));
  next(4, faces(3));
}

void Builder::run_level(const GoOnFunction& go_on) {
  const auto enough = static_cast<Index>(options_.level_share * faces_.face_count());
  // What rounding leaves of an error of 0, for quadrics of unit size.
  constexpr float kNothing = 1e-18f;
  // Wide buckets, as what comes next is known within one alone.
  CostQueue queue(vertices_left_, 8);
  for (const Index v : left_)
    if (plans_[v].cost < kNever) queue.push(v, plans_[v].cost);
  Index steps = 0;
  Star star;
  while (!is_small_enough() && queue.advance([](Index, float cost) { return cost; })) {
    if (go_on && ++steps % 1024 == 0 && !go_on()) return;
    const Index v = queue.front();
    queue.pop();
    fetch_ahead(queue);
    const float was = plans_[v].cost;
    if (was > kNothing && faces_.face_count() <= enough) return;
    if (marks_[v] == level_ || !faces_.gather(v, star)) continue;
    if (!is_current(v) || !creates_new_edges(faces_, star, plans_[v])) {
      if (!plan(v, star)) continue;
      if (plans_[v].cost > was) {
        queue.push(v, plans_[v].cost);
        continue;
      }
    }
    simplify_cluster(star, plans_[v]);
  }
}

// The quadrics of the other neighbours only grow, which makes the one that is kept no worse beside them: a plan is good
// as long as the star and what the kept neighbour stands for are what they were (is_current).
bool Builder::plan(Index v, const Star& star) {
  ClusterPlan& made = plans_[v];
  if (depth_of(star) > most_depth_ || operations_below(star) >= most_operations_) return false;
  if (!plan_cluster({faces_, errors_}, star, options_.cluster, made)) return false;
  if (made.operations > most_operations_) return false;
  // Twice as much for each.
  if (made.operations > even_operations_)
    made.cost = std::ldexp(made.cost, static_cast<int>(made.operations - even_operations_));
  planned_[v] = level_;
  return true;
}

void Builder::simplify_cluster(Star& star, const ClusterPlan& plan) {
  const unsigned depth = depth_of(star);
  const Index v = star.center, u = star.ring[plan.kept], w = star.ring[plan.opposite];
  faces_.fetch_around(star);
  errors_.fetch_quadric(u), errors_.fetch_quadric(w);
  std::array<Index, ClusterPlan::kMostSwaps> swapped;
  for (std::uint32_t i = 0; i < plan.swap_count; ++i) swapped[i] = star.ring[plan.swaps[i]];
  for (std::uint32_t i = 0; i < plan.swap_count; ++i) swap_edge(star, star.place_of(swapped[i]), depth);
  remove_vertex(star, u, errors_.removal_error(v, u), depth);
  for (std::uint32_t i = 0; i < star.count; ++i) marks_[star.ring[i]] = level_;
  for (std::uint32_t i = 0; i < plan.swap_count; ++i) planned_[swapped[i]] = 0;
  --vertices_left_;
  errors_.share(v, u, w);
  shared_[u] = shared_[w] = level_;
}

void Builder::swap_edge(Star& star, std::uint32_t place, unsigned depth) {
  const std::uint32_t before = place == 0 ? star.count - 1 : place - 1, after = place + 1 == star.count ? 0 : place + 1;
  const std::array<Index, 2> destroyed{triangle_of(star.spoke[before]), triangle_of(star.spoke[place])};
  const unsigned operations = 1 + std::max(operations_at(star.spoke[before]), operations_at(star.spoke[place]));
  const double error = errors_.swap_error(star.center, star.ring[place], star.ring[before], star.ring[after]);
  record_.add(faces_, star.center, error, destroyed, faces_.swap(star, place), depth, operations);
}

// Of four faces, or three, or the two of a border vertex.
void Builder::remove_vertex(const Star& star, Index u, double error, unsigned depth) {
  std::array<Index, 4> destroyed{};
  for (std::uint32_t i = 0; i < star.face_count(); ++i) destroyed[i] = triangle_of(star.spoke[i]);
  const unsigned operations = 1 + operations_below(star);
  std::array<Index, 2> left{};
  std::size_t left_count = 1;
  if (star.closed && star.count == 4) {
    const std::uint32_t first = star.place_of(u);
    left = faces_.remove_between_four(star, first, faces_.is_line(star.spoke[first]));
    left_count = 2;
  } else {
    left[0] = faces_.remove_between_three(star);
  }
  record_.add(faces_, star.center, error, std::span(destroyed).first(star.face_count()),
              std::span(left).first(left_count), depth, operations);
  record_.begin_with(u);
}

void Builder::limit_operations() {
  most_operations_ = even_operations_ = kAny;
  if (!(options_.height > 0)) return;
  const auto limit = [](double operations) { return static_cast<unsigned>(std::clamp(operations, 1.0, double{kAny})); };
  const double finest = log2_of(record_.finest_count());
  most_operations_ = limit(options_.height * finest);
  even_operations_ = limit(kEvenStart + kEvenShare * options_.height * (finest - log2_of(faces_.face_count())));
}

FourKMesh Builder::run(const GoOnFunction& go_on) {
  const Index levels = std::min(options_.levels, Index{250});
  while (record_.level_count() < levels && level_ < 250 && !is_small_enough() && !(go_on && !go_on())) {
    ++level_;
    most_depth_ = static_cast<unsigned>(
        std::clamp(options_.clusters_per_level * level_, static_cast<double>(level_), double{Face::kMostDepth}));
    limit_operations();
    price_all();
    run_level(go_on);
    if (record_.end_level()) continue;
    if (!options_.may_fold) break;
    if (options_.height > 0) {
      options_.height = 0;
    } else {
      if (options_.cluster.fold_over_cosine <= -1) break;
      options_.cluster.fold_over_cosine = -2;
    }
  }
  return std::move(record_).take();
}

}  // namespace

FourKMesh build_four_k(const Mesh& mesh, std::span<const Vec3f> positions, const FourKOptions& options,
                       const FourKTags& tags, GoOnFunction go_on) {
  return build_four_k(mesh, std::span(&positions, 1), options, tags, std::move(go_on));
}

FourKMesh build_four_k(const Mesh& mesh, std::span<const std::span<const Vec3f>> frames, const FourKOptions& options,
                       const FourKTags& tags, GoOnFunction go_on) {
  assert(!frames.empty() && frames[0].size() == mesh.vertex_count && options.threads >= 1);
  const SpatialMesh placed = in_spatial_order(mesh, frames[0]);
  const double scale = normalization(frames[0]).scale;
  const auto unit_positions = [&] {
    std::vector<Vec3d> all(mesh.vertex_count * frames.size());
    for (std::size_t f = 0; f < frames.size(); ++f) {
      Normalization normalize = normalization(frames[f]);
      normalize.scale = scale;
      for (Index i = 0; i < mesh.vertex_count; ++i)
        all[i * frames.size() + f] = normalize.to_unit(frames[f][placed.order[i]]);
    }
    return all;
  };
  std::optional<Builder> builder(std::in_place, placed.mesh, unit_positions(), frames.size(), options);
  if (builder->has_turned_edges()) {
    Mesh alike = placed.mesh;
    orient_alike(alike);
    builder.emplace(alike, unit_positions(), frames.size(), options);
  }
  for (const Index v : tags.vertices) builder->keep(placed.places[v]);
  for (const auto& [a, b] : tags.edges) builder->tag_edge(placed.places[a], placed.places[b]);
  FourKMesh made = builder->run(go_on);
  for (Triangle& t : made.triangles)
    for (Index& corner : t) corner = placed.order[corner];
  for (Index& v : made.vertex) v = placed.order[v];
  make_monotone(made, frames[0], scale);
  return made;
}

}  // namespace limber
