// SPDX-License-Identifier: Apache-2.0
// A least squares fit by closest points. Neither paper has it: theirs stand at the minima of their quadrics.
//
//   for each level, from fine to coarse; its samples are the nodes of a finer level, kSamplesPerNode times as many:
//     repeat `rounds` times:
//       for every sample p of weight w, its area, in the cluster of node i:
//         c = the closest point to p on the level's triangles around i; at its corners j it has the weights b_j
//         r = p - c, d = r/|r|: small moves m_j of the nodes make the distance  (r - sum of b_j m_j).d
//       move each node j to the minimum of  sum of w b_j ((r - m_j).d)^2 + anchor x its quadric
//
// The weights b_j sum up to 1, so that the sum over the nodes bounds the squared distances from above (Jensen), and a
// round lowers these without a step to choose. The quadric looks the other way, from the level to the finest surface:
// without it triangles sink into folds that no sample asks for (docs/design.md, "Placement").
#include "limber/hierarchy/level_fit.h"

#include <algorithm>
#include <cassert>

namespace limber {
namespace {

constexpr Index kSamplesPerNode = 6;

// Counts to the ends of groups; what fills them from behind leaves the beginnings.
void sums(std::vector<Index>& begin) {
  Index sum = 0;
  for (Index& b : begin) sum += b, b = sum;
}

double reciprocal(double x) { return x > 0 ? 1 / x : 0; }

}  // namespace

LevelFit::LevelFit(const Mesh& mesh, const Hierarchy& hierarchy)
    : mesh_(mesh), hierarchy_(hierarchy), areas_(hierarchy.node_count()) {}

void LevelFit::sum_areas(std::span<const double> vertex_areas) {
  std::fill(std::copy(vertex_areas.begin(), vertex_areas.end(), areas_.begin()), areas_.end(), 0.0);
  for (Index node = 0; node < hierarchy_.node_count(); ++node)
    if (hierarchy_.parent[node] != kNone) areas_[hierarchy_.parent[node]] += areas_[node];
}

// From the level below: its triangles, and the fans that they make around its nodes.
void LevelFit::go_up(Index level) {
  first_ = hierarchy_.level_begin[level];
  fan_begin_.assign(std::size_t{hierarchy_.level_size(level)} + 1, 0);
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
  for (auto t = static_cast<Index>(kept); t-- > 0;)
    for (const Index node : triangles_[t]) fans_[--fan_begin_[node - first_]] = t;
}

Index LevelFit::sample_level(Index level) const {
  Index samples = level - 1;
  while (samples > 0 && hierarchy_.level_size(samples) < std::uint64_t{kSamplesPerNode} * hierarchy_.level_size(level))
    --samples;
  return samples;
}

void LevelFit::find_members(Index level) {
  const Index samples = sample_level(level);
  const Index begin = hierarchy_.level_begin[samples];
  clusters_.resize(hierarchy_.level_size(samples));
  member_begin_.assign(std::size_t{hierarchy_.level_size(level)} + 1, 0);
  for (std::size_t i = 0; i < clusters_.size(); ++i) {
    auto node = static_cast<Index>(begin + i);
    for (Index up = samples; up < level; ++up) node = hierarchy_.parent[node];
    clusters_[i] = node;
    ++member_begin_[node - first_];
  }
  sums(member_begin_);
  members_.resize(clusters_.size());
  for (std::size_t i = clusters_.size(); i-- > 0;)
    members_[--member_begin_[clusters_[i] - first_]] = static_cast<Index>(begin + i);
}

void LevelFit::look_around(Index node, std::span<const Vec3d> positions) {
  wedges_.clear();
  const Vec3d& origin = positions[node];
  for (Index i = fan_begin_[node - first_]; i < fan_begin_[node - first_ + 1]; ++i) {
    const Triangle& t = triangles_[fans_[i]];
    const unsigned at = t[0] == node ? 0 : t[1] == node ? 1 : 2;
    const Index a = t[(at + 1) % 3], b = t[(at + 2) % 3];
    const Vec3d to_a = positions[a] - origin, to_b = positions[b] - origin;
    const double aa = squared_length(to_a), ab = dot(to_a, to_b), bb = squared_length(to_b);
    const double det = aa * bb - ab * ab;
    wedges_.push_back({to_a, to_b, aa, ab, bb, det > 1e-12 * aa * bb ? 1 / det : 0, reciprocal(aa), reciprocal(bb),
                       reciprocal(aa - 2 * ab + bb), a, b});
  }
}

// The closest of the points that the node's triangles have right below; where there is none, on their sides.
LevelFit::Place LevelFit::closest(const Vec3d& point) const {
  Place best;
  for (const Wedge& w : wedges_) {
    const double pa = dot(point, w.to_a), pb = dot(point, w.to_b);
    const double a = (w.bb * pa - w.ab * pb) * w.by_det, b = (w.aa * pb - w.ab * pa) * w.by_det;
    const double gain = a * pa + b * pb;
    if (w.by_det > 0 && a >= 0 && b >= 0 && a + b <= 1 && gain > best.gain) best = {gain, a, b, &w};
  }
  if (best.wedge != nullptr) return best;
  for (const Wedge& w : wedges_) {
    const double pa = dot(point, w.to_a), pb = dot(point, w.to_b);
    const double s = std::clamp(pa * w.by_aa, 0.0, 1.0);
    if (const double gain = s * (2 * pa - s * w.aa); gain > best.gain) best = {gain, s, 0, &w};
    const double t = std::clamp(pb * w.by_bb, 0.0, 1.0);
    if (const double gain = t * (2 * pb - t * w.bb); gain > best.gain) best = {gain, 0, t, &w};
    const double u = std::clamp((pb - pa + w.aa - w.ab) * w.by_cc, 0.0, 1.0), v = 1 - u;
    const double across = v * (2 * pa - v * w.aa) + u * (2 * pb - u * w.bb) - 2 * u * v * w.ab;
    if (across > best.gain) best = {across, v, u, &w};
  }
  return best;
}

// point: from the node.
void LevelFit::pull_towards(const Vec3d& point, double weight, Index node) {
  const Place best = closest(point);
  const Vec3d r = point - best.wedge->to_a * best.a - best.wedge->to_b * best.b;
  const double squared = squared_length(r);
  if (!(squared > 1e-24)) return;
  const auto pull = [&](Index at, double share) {
    if (!(share > 0)) return;
    Pull& p = pulls_[at - first_];
    const double w = weight * share, s = w / squared;
    p.xx += s * r.x * r.x, p.xy += s * r.x * r.y, p.xz += s * r.x * r.z;
    p.yy += s * r.y * r.y, p.yz += s * r.y * r.z, p.zz += s * r.z * r.z;
    p.force = p.force + r * w;
  };
  pull(node, 1 - best.a - best.b);
  pull(best.wedge->a, best.a);
  pull(best.wedge->b, best.b);
}

// To the minimum of what pulls and of the quadric.
void LevelFit::move(Index node, const Quadric& q, double anchor, Vec3d& x) const {
  const Pull& p = pulls_[node - first_];
  const Vec3d slope{q.xx * x.x + q.xy * x.y + q.xz * x.z + q.bx, q.xy * x.x + q.yy * x.y + q.yz * x.z + q.by,
                    q.xz * x.x + q.yz * x.y + q.zz * x.z + q.bz};
  const Vec3d b = slope * anchor - p.force;
  const Quadric from_here{p.xx + anchor * q.xx,
                          p.xy + anchor * q.xy,
                          p.xz + anchor * q.xz,
                          p.yy + anchor * q.yy,
                          p.yz + anchor * q.yz,
                          p.zz + anchor * q.zz,
                          b.x,
                          b.y,
                          b.z,
                          0};
  x = x + minimum(from_here).point;
}

void LevelFit::fit(std::span<const double> vertex_areas, std::span<const Quadric> quadrics, const FitOptions& options,
                   std::span<Vec3d> positions) {
  assert(vertex_areas.size() == hierarchy_.vertex_count());
  assert(quadrics.size() == areas_.size() && positions.size() == areas_.size());
  if (options.rounds == 0) return;
  sum_areas(vertex_areas);
  triangles_ = mesh_.triangles;
  for (Index level = 1; level < hierarchy_.level_count(); ++level) {
    go_up(level);
    find_members(level);
    const Index end = hierarchy_.level_begin[level + 1];
    for (unsigned round = 0; round < options.rounds; ++round) {
      pulls_.assign(end - first_, {});
      for (Index node = first_; node < end; ++node) {
        look_around(node, positions);
        if (wedges_.empty()) continue;
        for (Index i = member_begin_[node - first_]; i < member_begin_[node - first_ + 1]; ++i)
          pull_towards(positions[members_[i]] - positions[node], areas_[members_[i]], node);
      }
      for (Index node = first_; node < end; ++node) move(node, quadrics[node], options.anchor, positions[node]);
    }
  }
}

}  // namespace limber
