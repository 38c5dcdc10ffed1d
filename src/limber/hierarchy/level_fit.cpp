// SPDX-License-Identifier: Apache-2.0
// A least squares fit by closest points. Neither paper has it: theirs stand at the minima of their quadrics.
//
//   for each level, from fine to coarse; its samples are the nodes of a finer level, kSamplesPerNode times as many, or,
//   where the finest has not so many, its vertices and the middles of its triangles:
//     repeat `rounds` times, the first time with every other sample, and no more than a dozen of a cluster:
//       for every sample p of weight w, its area, in the cluster of node i:
//         c = the closest point to p on the level's triangles around i; at its corners j it has the weights b_j
//         r = p - c, d = r/|r|: small moves m_j of the nodes make the distance  (r - sum of b_j m_j).d
//       move each node j to the minimum of  sum of w b_j ((r - m_j).d)^2 + anchor x its quadric, no further than
//       its reach from where it was at first
//     draw back the nodes of triangles that have been turned over
//
// The weights b_j sum up to 1, so that the sum over the nodes bounds the squared distances from above (Jensen), and a
// round lowers these without a step to choose. The quadric looks the other way, from the level to the finest surface:
// without it triangles sink into folds that no sample asks for (docs/design.md, "Placement").
#include "limber/hierarchy/level_fit.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace limber {
namespace {

constexpr Index kSamplesPerNode = 6;
constexpr Index kRoughSamples = 12;  // of a cluster, at most: three times four of them
// Weight of a node's way, against the pulls at it: what keeps it from far places along a surface that says little about
// them.
constexpr double kDamping = 0.001;
// Of the side of a square as large as the cluster: beyond, a node slides past others, or out over a border. That is if
// the cluster is flat: see squared_reach().
constexpr double kReach = 0.5;
constexpr double kLeastShadow = 1.0 / 16;  // of a cluster's area
// What is left of a quadric is the squared distance to planes, about twice that to the surface they bound.
constexpr double kPlanes = 0.5;
constexpr int kHalvings = 3;  // before a node is drawn back for good

// What a cluster's area is over the side of a square as large as its shadow on a plane across: on a tip that is about
// as much as the tip is long, whose quadric hardly says where it ends.
double squared_reach(const Facing& cluster) {
  const double shadow = std::max(length(cluster.vector), kLeastShadow * cluster.area);
  return shadow > 0 ? kReach * kReach * cluster.area * (cluster.area / shadow) : 0;
}

// Counts to the ends of groups; what fills them from behind leaves the beginnings.
void sums(std::vector<Index>& begin) {
  Index sum = 0;
  for (Index& b : begin) sum += b, b = sum;
}

// Four rows of four numbers, the other way round.
std::array<Float4, 4> transposed(Float4 a, Float4 b, Float4 c, Float4 d) {
  const Float4 ab = __builtin_shufflevector(a, b, 0, 4, 1, 5), cd = __builtin_shufflevector(c, d, 0, 4, 1, 5);
  const Float4 ab2 = __builtin_shufflevector(a, b, 2, 6, 3, 7), cd2 = __builtin_shufflevector(c, d, 2, 6, 3, 7);
  return {__builtin_shufflevector(ab, cd, 0, 1, 4, 5), __builtin_shufflevector(ab, cd, 2, 3, 6, 7),
          __builtin_shufflevector(ab2, cd2, 0, 1, 4, 5), __builtin_shufflevector(ab2, cd2, 2, 3, 6, 7)};
}

}  // namespace

std::array<LevelFit::Pull, 4> LevelFit::Pulls::each() const {
  const auto s = transposed(squares[0], squares[1], squares[2], squares[3]);
  const auto p = transposed(products[0], products[1], products[2], Float4{});
  const auto f = transposed(force[0], force[1], force[2], Float4{});
  return {{{s[0], p[0], f[0]}, {s[1], p[1], f[1]}, {s[2], p[2], f[2]}, {s[3], p[3], f[3]}}};
}

LevelFit::LevelFit(const Mesh& mesh, const Hierarchy& hierarchy) : mesh_(mesh), hierarchy_(hierarchy) {}

// From the level below: its triangles, and the fans that they make around its nodes.
void LevelFit::go_up(Index level) {
  first_ = hierarchy_.level_begin[level], end_ = hierarchy_.level_begin[level + 1];
  fan_begin_.assign(std::size_t{end_ - first_} + 1, 0);
  std::size_t kept = 0;
  for (const Triangle& t : triangles_) {
    const Triangle image{hierarchy_.parent[t[0]], hierarchy_.parent[t[1]], hierarchy_.parent[t[2]]};
    if (is_degenerate(image)) continue;
    triangles_[kept++] = image;
    for (const Index node : image) ++fan_begin_[node - first_];
  }
  triangles_.resize(kept);
  sums(fan_begin_);
  fans_.resize(3 * kept);
  for (std::size_t t = kept; t-- > 0;) {
    const auto [a, b, c] = triangles_[t];
    fans_[--fan_begin_[a - first_]] = {b, c};
    fans_[--fan_begin_[b - first_]] = {c, a};
    fans_[--fan_begin_[c - first_]] = {a, b};
  }
}

Index LevelFit::sample_level(Index level) const {
  Index samples = level - 1;
  while (samples > 0 && hierarchy_.level_size(samples) < std::uint64_t{kSamplesPerNode} * hierarchy_.level_size(level))
    --samples;
  return samples;
}

void LevelFit::find_members(Index level, std::span<const Vec3d> positions) {
  const Index samples = sample_level(level);
  const Index begin = hierarchy_.level_begin[samples];
  Index from = level - 1;  // the clusters are known on this level
  if (level == 1 || samples != samples_) {
    clusters_.resize(hierarchy_.level_size(samples));
    for (std::size_t i = 0; i < clusters_.size(); ++i) clusters_[i] = static_cast<Index>(begin + i);
    from = samples;
  }
  samples_ = samples;
  member_begin_.assign(std::size_t{end_ - first_} + 1, 0);
  for (Index& cluster : clusters_) {
    for (Index up = from; up < level; ++up) cluster = hierarchy_.parent[cluster];
    ++member_begin_[cluster - first_];
  }
  const std::size_t triangle_count = has_centroids() ? mesh_.triangles.size() : 0;
  for (std::size_t t = 0; t < triangle_count; ++t) ++member_begin_[cluster_of(mesh_.triangles[t]) - first_];
  sums(member_begin_);
  members_.resize(clusters_.size() + triangle_count);
  for (std::size_t t = triangle_count; t-- > 0;)
    members_[--member_begin_[cluster_of(mesh_.triangles[t]) - first_]] = centroid(t, positions);
  for (std::size_t i = clusters_.size(); i-- > 0;)
    members_[--member_begin_[clusters_[i] - first_]] = {positions[begin + i], facings_[begin + i].area};
}

// Of a finest triangle, where samples are of the finest level: that of two corners, or of any.
Index LevelFit::cluster_of(const Triangle& t) const {
  const Index a = clusters_[t[0]], b = clusters_[t[1]], c = clusters_[t[2]];
  return b == c ? b : a;
}

// Vertices alone do not see what two of them in a cluster leave between.
bool LevelFit::has_centroids() const {
  return samples_ == 0 && hierarchy_.vertex_count() < std::uint64_t{kSamplesPerNode} * (end_ - first_);
}

LevelFit::Sample LevelFit::centroid(std::size_t triangle, std::span<const Vec3d> positions) const {
  const auto& [a, b, c] = mesh_.triangles[triangle];
  const Vec3d &p = positions[a], &q = positions[b], &r = positions[c];
  return {(p + q + r) * (1.0 / 3), 1.5 * length(cross(q - p, r - p))};
}

void LevelFit::look_around(Index node, std::span<const Vec3d> positions) {
  const Vec3d& origin = positions[node];
  fan_.clear();
  for (Index i = fan_begin_[node - first_]; i < fan_begin_[node - first_ + 1]; ++i) {
    const auto [a, b] = fans_[i];
    fan_.add(a, Vec3f(positions[a] - origin), b, Vec3f(positions[b] - origin));
  }
  fan_.finish();
}

// points: from the node. Gives what pulls at the node itself.
void LevelFit::pull_towards(const Vector4& points, Float4 weights, Pulls& at_node) {
  const Fan::Places place = fan_.closest(points);
  const auto& [x, y, z] = place.direction;
  const Float4 w = weights * place.by_squared, ws = weights * place.steps;
  const Pulls pulls{{w * x * x, w * y * y, w * z * z, ws * place.steps * (x * x + y * y + z * z)},
                    {w * x * y, w * x * z, w * y * z},
                    {ws * x, ws * y, ws * z}};
  at_node.add(pulls, 1 - place.at_a - place.at_b);
  const std::array<Pull, 4> each = pulls.each();
  const auto add = [&](Index at, unsigned lane, float share) {
    if (share > 0) pulls_[at - first_].add(each[lane], share);
  };
  for (unsigned lane = 0; lane < 4; ++lane) {
    if (!(weights[lane] > 0)) continue;
    add(place.a[lane], lane, place.at_a[lane]);
    add(place.b[lane], lane, place.at_b[lane]);
  }
}

// Of all nodes, and with all samples if not roughly.
void LevelFit::pull(std::span<const Vec3d> positions, bool roughly) {
  pulls_.assign(end_ - first_, {});
  // With centroids each triangle is integrated as a quadratic: a twelfth for each corner, three quarters for its
  // middle.
  const double share = has_centroids() ? 0.25 : 1;
  for (Index node = first_; node < end_; ++node) {
    const Index begin = member_begin_[node - first_], end = member_begin_[node - first_ + 1], count = end - begin;
    const Index step = roughly && count >= 4 ? std::max<Index>(2, (count + kRoughSamples - 1) / kRoughSamples) : 1;
    look_around(node, positions);
    if (fan_.empty()) continue;
    Pulls at_node;
    for (Index i = begin; i < end;) {
      Vector4 points{};
      Float4 weights{};
      for (unsigned lane = 0; lane < 4 && i < end; ++lane, i += step) {
        const auto& [point, area] = members_[i];
        const Vec3f p(point - positions[node]);
        points.x[lane] = p.x, points.y[lane] = p.y, points.z[lane] = p.z;
        weights[lane] = static_cast<float>(step * share * area);
      }
      pull_towards(points, weights, at_node);
    }
    for (const Pull& pull : at_node.each()) pulls_[node - first_].add(pull, 1);
  }
}

// Every node to the minimum of what pulls and of its quadric.
void LevelFit::move(std::span<const Quadric> quadrics, double anchor, std::span<Vec3d> positions,
                    std::span<double> errors) {
  for (Index node = first_; node < end_; ++node) {
    const auto& [squares, products, force] = pulls_[node - first_];
    const Quadric p{squares[0], products[0], products[1], squares[1], products[2],
                    squares[2], -force[0],   -force[1],   -force[2],  squares[3]};
    const Vec3d& x = positions[node];
    Quadric q = quadrics[node];  // seen from x
    q.bx += q.xx * x.x + q.xy * x.y + q.xz * x.z;
    q.by += q.xy * x.x + q.yy * x.y + q.yz * x.z;
    q.bz += q.xz * x.x + q.yz * x.y + q.zz * x.z;
    q.c = quadrics[node](x);
    Quadric sum = q;
    sum *= anchor;
    sum += p;
    sum.add_point({}, kDamping * p.trace());
    const Vec3d& home = minima_[node - first_];
    Vec3d way = minimum(sum).point;
    if (const double far_2 = squared_length(x + way - home), most_2 = squared_reach(facings_[node]); far_2 > most_2)
      way = home + (x + way - home) * std::sqrt(most_2 / far_2) - x;
    const double left = 0.5 * std::max(p(way), 0.0) + 0.5 * kPlanes * std::max(q(way), 0.0);
    if (!std::isfinite(left)) continue;  // millions of times larger than the first frame
    positions[node] += way;
    if (fan_begin_[node - first_] < fan_begin_[node - first_ + 1]) errors[node] = left;
  }
}

// And is not so at the minima.
bool LevelFit::is_turned_over(const Triangle& t, std::span<const Vec3d> positions) const {
  Facing surface;
  for (const Index node : t) surface += facings_[node];
  const Vec3d &a = minima_[t[0] - first_], &b = minima_[t[1] - first_], &c = minima_[t[2] - first_];
  return limber::is_turned_over(positions[t[0]], positions[t[1]], positions[t[2]], surface) &&
         !limber::is_turned_over(a, b, c, surface);
}

void LevelFit::draw_back(const Triangle& triangle, double share, std::span<Vec3d> positions) {
  for (const Index node : triangle) {
    const Vec3d& minimum = minima_[node - first_];
    if (positions[node] == minimum) continue;
    positions[node] = minimum + (positions[node] - minimum) * share;
    drawn_back_.push_back(node);
  }
}

// What turns over because its neighbour is drawn back goes back altogether, each node once: that ends.
void LevelFit::turn_back(std::span<Vec3d> positions) {
  drawn_back_.clear();
  for (const Triangle& t : triangles_)
    for (int i = 0; is_turned_over(t, positions); ++i) draw_back(t, i < kHalvings ? 0.5 : 0.0, positions);
  for (std::size_t i = 0; i < drawn_back_.size(); ++i) {
    const Index node = drawn_back_[i];
    for (Index k = fan_begin_[node - first_]; k < fan_begin_[node - first_ + 1]; ++k)
      if (const Triangle t{node, fans_[k].a, fans_[k].b}; is_turned_over(t, positions)) draw_back(t, 0, positions);
  }
}

void LevelFit::fit(std::span<const Quadric> quadrics, std::span<const Facing> facings, const FitOptions& options,
                   std::span<Vec3d> positions, std::span<double> errors) {
  assert(quadrics.size() == hierarchy_.node_count() && facings.size() == quadrics.size());
  assert(positions.size() == quadrics.size() && errors.size() == quadrics.size());
  if (options.rounds == 0) return;
  facings_ = facings;
  triangles_ = mesh_.triangles;
  for (Index level = 1; level < hierarchy_.level_count(); ++level) {
    go_up(level);
    find_members(level, positions);
    minima_.assign(positions.begin() + first_, positions.begin() + end_);
    for (unsigned round = 0; round < options.rounds; ++round) {
      pull(positions, round == 0 && options.rounds > 1);
      move(quadrics, options.anchor, positions, errors);
    }
    turn_back(positions);
  }
}

}  // namespace limber
