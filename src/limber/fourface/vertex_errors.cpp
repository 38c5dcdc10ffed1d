// SPDX-License-Identifier: Apache-2.0
#include "limber/fourface/vertex_errors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "limber/fourface/pair.h"

namespace limber {

VertexErrors::VertexErrors(const Mesh& mesh, std::vector<Vec3d> positions, std::size_t frame_count,
                           const QuadricOptions& options, bool is_closed)
    : options_(options),
      frame_count_(frame_count),
      positions_(std::move(positions)),
      quadrics_(positions_.size()),
      own_error_(mesh.vertex_count) {
  VertexQuadrics finest(mesh, is_closed ? Edges{} : find_edges(mesh), options_);
  if (frame_count_ == 1) {
    finest.compute(positions_, quadrics_);
  } else {
    std::vector<Vec3d> of_frame(mesh.vertex_count);
    std::vector<Quadric> quadrics(mesh.vertex_count);
    for (std::size_t f = 0; f < frame_count_; ++f) {
      for (Index v = 0; v < mesh.vertex_count; ++v) of_frame[v] = at(v, f);
      finest.compute(of_frame, quadrics);
      for (Index v = 0; v < mesh.vertex_count; ++v) quadrics_[v * frame_count_ + f] = quadrics[v];
    }
  }
  for (Index v = 0; v < mesh.vertex_count; ++v) sum_own(v);
  find_normals(mesh);
}

void VertexErrors::find_normals(const Mesh& mesh) {
  std::vector<Vec3d> sums(positions_.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    for (std::size_t f = 0; f < frame_count_; ++f) {
      const Vec3d area = cross(at(b, f) - at(a, f), at(c, f) - at(a, f));
      for (const Index corner : {a, b, c}) sums[corner * frame_count_ + f] += area;
    }
  }
  normals_.resize(sums.size());
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const double size = length(sums[i]);
    if (size > 0) normals_[i] = static_cast<Vec3f>(sums[i] * (1 / size));
  }
}

void VertexErrors::sum_own(Index v) {
  double sum = 0;
  for (std::size_t f = 0; f < frame_count_; ++f) sum += quadrics_[v * frame_count_ + f](at(v, f));
  own_error_[v] = sum;
}

void VertexErrors::hold_line(const FaceTable& faces, Index half_edge) {
  const Index a = faces.origin(half_edge), b = faces.target(half_edge);
  for (const Index h : {half_edge, faces.twin(half_edge)}) {
    const Index beside = faces.origin(FaceTable::previous(h));
    for (std::size_t f = 0; f < frame_count_; ++f) {
      const Vec3d from = at(faces.origin(h), f), along = at(faces.target(h), f) - from;
      const Vec3d across = cross(along, cross(along, at(beside, f) - from));
      const double size = length(across);
      if (!(size > 0)) continue;
      const double weight = 0.5 * options_.border_weight * squared_length(along);
      const Quadric plane = Quadric::plane(across * (1 / size), from, weight);
      quadrics_[a * frame_count_ + f] += plane;
      quadrics_[b * frame_count_ + f] += plane;
    }
  }
  sum_own(a), sum_own(b);
}

double VertexErrors::least_removal(const FaceTable& faces, Index v) const {
  Star star;
  std::array<double, Star::kMostNeighbours> costs;
  if (!faces.gather(v, star)) return std::numeric_limits<double>::infinity();
  removal_costs(star, costs);
  return *std::min_element(costs.begin(), costs.begin() + star.count);
}

void VertexErrors::removal_costs(const Star& star, std::span<double> costs) const {
  for (std::uint32_t i = 0; i < star.count; i += 2) {
    const Index u = star.ring[i], w = star.ring[std::min(i + 1, star.count - 1)];
    Pair sum{own_error_[u], own_error_[w]};
    for (std::size_t f = 0; f < frame_count_; ++f) {
      const Quadric& q = quadrics_[star.center * frame_count_ + f];
      const Vec3d &p = at(u, f), &o = at(w, f);
      const Pair x{p.x, o.x}, y{p.y, o.y}, z{p.z, o.z};
      const Pair rx = q.xx * x + q.xy * y + q.xz * z + 2 * q.bx;
      const Pair ry = q.xy * x + q.yy * y + q.yz * z + 2 * q.by;
      const Pair rz = q.xz * x + q.yz * y + q.zz * z + 2 * q.bz;
      sum += rx * x + ry * y + rz * z + q.c;
    }
    costs[i] = std::max(sum[0], 0.0);
    if (i + 1 < star.count) costs[i + 1] = std::max(sum[1], 0.0);
  }
}

double VertexErrors::swap_error(Index v, Index r, Index s, Index t) const {
  double largest = 0;
  for (std::size_t f = 0; f < frame_count_; ++f) {
    const Vec3d across = cross(at(r, f) - at(v, f), at(t, f) - at(s, f));
    const double size = length(across);
    if (size > 0) largest = std::max(largest, std::fabs(dot(at(s, f) - at(v, f), across)) / size);
  }
  return largest;
}

double VertexErrors::removal_error(Index v, Index u) const {
  double sum = 0, weight = 0;
  for (std::size_t f = 0; f < frame_count_; ++f) {
    const Quadric& q = quadrics_[v * frame_count_ + f];
    sum += q(at(u, f));
    weight += q.trace();
  }
  return weight > 0 ? std::sqrt(std::max(sum, 0.0) / weight) : 0;
}

void VertexErrors::share(Index v, Index u, Index w) {
  double share = 1;
  if (u != w) {
    const double cu = removal_cost(v, u), cw = removal_cost(v, w);
    share = cu + cw > 0 ? 1 - cu / (cu + cw) : 0.5;
  }
  for (std::size_t f = 0; f < frame_count_; ++f) {
    const Quadric& qv = quadrics_[v * frame_count_ + f];
    if (u == w) {
      quadrics_[u * frame_count_ + f] += qv;
      continue;
    }
    Quadric to_u = qv, to_w = qv;
    to_u *= share, to_w *= 1 - share;
    quadrics_[u * frame_count_ + f] += to_u;
    quadrics_[w * frame_count_ + f] += to_w;
  }
  sum_own(u);
  if (u != w) sum_own(w);
}

}  // namespace limber
