// SPDX-License-Identifier: Apache-2.0
// Horn 1987, "Closed-form solution of absolute orientation using unit quaternions", section 4: the best rotation is the
// eigenvector of the largest eigenvalue of a symmetric 4 x 4 matrix, found by Jacobi's rotations.
#include "eval/methods/local_motion.h"

#include <algorithm>
#include <cmath>

#include "limber/contract/edges.h"

namespace limber::eval {
namespace {

using Matrix4 = std::array<std::array<double, 4>, 4>;

struct Eigen {
  double value = 0;
  std::array<double, 4> vector{};  // of length 1
};

// Makes m[p][q] nothing; `vectors` holds the eigenvectors so far as columns.
void rotate(Matrix4& m, Matrix4& vectors, std::size_t p, std::size_t q) {
  const double theta = (m[q][q] - m[p][p]) / (2 * m[p][q]);
  const double t = (theta < 0 ? -1 : 1) / (std::abs(theta) + std::sqrt(theta * theta + 1));
  const double c = 1 / std::sqrt(t * t + 1), s = t * c;
  for (auto& row : m) {
    const double a = row[p], b = row[q];
    row[p] = c * a - s * b, row[q] = s * a + c * b;
  }
  for (std::size_t k = 0; k < 4; ++k) {
    const double a = m[p][k], b = m[q][k];
    m[p][k] = c * a - s * b, m[q][k] = s * a + c * b;
  }
  for (auto& row : vectors) {
    const double a = row[p], b = row[q];
    row[p] = c * a - s * b, row[q] = s * a + c * b;
  }
}

Eigen largest_eigenvalue(Matrix4 m) {
  Matrix4 vectors{};
  double size = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    vectors[i][i] = 1;
    for (const double x : m[i]) size = std::max(size, std::abs(x));
  }
  constexpr int kMostSweeps = 16;  // five are enough for all but the strangest
  bool is_diagonal = false;
  for (int sweep = 0; sweep < kMostSweeps && !is_diagonal; ++sweep) {
    is_diagonal = true;
    for (std::size_t p = 0; p < 4; ++p) {
      for (std::size_t q = p + 1; q < 4; ++q) {
        if (std::abs(m[p][q]) <= 1e-15 * size) continue;
        is_diagonal = false;
        rotate(m, vectors, p, q);
      }
    }
  }
  std::size_t best = 0;
  for (std::size_t i = 1; i < 4; ++i)
    if (m[i][i] > m[best][best]) best = i;
  return {m[best][best], {vectors[0][best], vectors[1][best], vectors[2][best], vectors[3][best]}};
}

// `rows`: sums of products, row: coordinate at rest, column: coordinate moved.
Matrix4 horn_matrix(const std::array<Vec3d, 3>& rows) {
  const auto& [x, y, z] = rows;
  return {{{x.x + y.y + z.z, y.z - z.y, z.x - x.z, x.y - y.x},
           {y.z - z.y, x.x - y.y - z.z, x.y + y.x, z.x + x.z},
           {z.x - x.z, x.y + y.x, y.y - x.x - z.z, y.z + z.y},
           {x.y - y.x, z.x + x.z, y.z + z.y, z.z - x.x - y.y}}};
}

std::array<Vec3d, 3> turned_axes(const std::array<double, 4>& quaternion) {
  const auto [w, x, y, z] = quaternion;
  return {Vec3d{w * w + x * x - y * y - z * z, 2 * (x * y + w * z), 2 * (x * z - w * y)},
          Vec3d{2 * (x * y - w * z), w * w - x * x + y * y - z * z, 2 * (y * z + w * x)},
          Vec3d{2 * (x * z + w * y), 2 * (y * z - w * x), w * w - x * x - y * y + z * z}};
}

Vec3d edge_vector(std::span<const Vec3f> positions, const std::array<Index, 2>& ends) {
  return static_cast<Vec3d>(positions[ends[1]]) - static_cast<Vec3d>(positions[ends[0]]);
}

}  // namespace

LocalMotions::LocalMotions(const Mesh& mesh, std::span<const Vec3f> rest)
    : edges_(find_edges(mesh).ends), sums_(mesh.vertex_count) {
  rest_edges_.reserve(edges_.size());
  for (const auto& ends : edges_) rest_edges_.push_back(edge_vector(rest, ends));
}

void LocalMotions::fit(std::span<const Vec3f> positions, std::span<LocalMotion> motions) {
  std::ranges::fill(sums_, Sums{});
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    const Vec3d& rest = rest_edges_[e];
    const Vec3d moved = edge_vector(positions, edges_[e]);
    for (const Index end : edges_[e]) {
      Sums& sums = sums_[end];
      sums.products[0] += moved * rest.x, sums.products[1] += moved * rest.y, sums.products[2] += moved * rest.z;
      sums.rest += squared_length(rest);
      sums.moved += squared_length(moved);
    }
  }
  for (std::size_t v = 0; v < sums_.size(); ++v) {
    const Sums& sums = sums_[v];
    const Eigen turn = largest_eigenvalue(horn_matrix(sums.products));
    const double left = std::max(0.0, sums.rest + sums.moved - 2 * turn.value);
    motions[v] = {turned_axes(turn.vector), sums.rest > 0 ? std::sqrt(left / sums.rest) : 0.0};
  }
}

}  // namespace limber::eval
