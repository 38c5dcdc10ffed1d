// SPDX-License-Identifier: Apache-2.0
//   sort the sides of all triangles by their two vertices
//   of each edge: one side, or two that run in opposite directions, which join the triangles' corners at either end
//   of each vertex: all corners are joined
#include "eval/peers/oriented_manifold.h"

#include <algorithm>
#include <cstddef>
#include <fmt/format.h>
#include <numeric>
#include <string>
#include <tuple>
#include <utility>

namespace limber::eval {
namespace {

// From corner k of a triangle to the next.
struct Side {
  Index low, high;
  std::size_t corner;  // 3 * triangle + k
  bool forward;        // from low to high
};

std::vector<Side> sides_of(const Mesh& mesh) {
  std::vector<Side> sides;
  sides.reserve(3 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Index from = mesh.triangles[t][k], to = mesh.triangles[t][(k + 1) % 3];
      sides.push_back({std::min(from, to), std::max(from, to), 3 * t + k, from < to});
    }
  }
  std::ranges::sort(sides, {}, [](const Side& s) { return std::tuple(s.low, s.high, s.corner); });
  return sides;
}

Error error_at(std::string where, std::string what) {
  return {ErrorCode::kBadInput, std::move(where), std::move(what)};
}

// The corners of all triangles, in sets.
class Corners {
 public:
  explicit Corners(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }

  std::size_t set_of(std::size_t corner) {
    while (parent_[corner] != corner) corner = parent_[corner] = parent_[parent_[corner]];
    return corner;
  }

  void join(std::size_t a, std::size_t b) { parent_[set_of(a)] = set_of(b); }

 private:
  std::vector<std::size_t> parent_;
};

std::size_t next(std::size_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }

}  // namespace

Result<void> check_oriented_manifold(const Mesh& mesh) {
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (is_degenerate(mesh.triangles[t])) return error_at(fmt::format("triangle {}", t), "names a vertex twice");
  }
  const std::vector<Side> sides = sides_of(mesh);
  Corners corners(sides.size());
  for (std::size_t first = 0, end; first < sides.size(); first = end) {
    const Side& a = sides[first];
    for (end = first + 1; end < sides.size() && sides[end].low == a.low && sides[end].high == a.high;) ++end;
    const auto edge = [&] { return fmt::format("edge between vertices {} and {}", a.low, a.high); };
    if (end - first > 2) return error_at(edge(), fmt::format("lies on {} triangles", end - first));
    if (end - first < 2) continue;
    const Side& b = sides[first + 1];
    if (a.forward == b.forward) return error_at(edge(), "its two triangles face opposite ways");
    corners.join(a.corner, next(b.corner));
    corners.join(b.corner, next(a.corner));
  }
  std::vector<std::size_t> fan_of(mesh.vertex_count, sides.size());
  for (std::size_t corner = 0; corner < sides.size(); ++corner) {
    const Index vertex = mesh.triangles[corner / 3][corner % 3];
    const std::size_t fan = corners.set_of(corner);
    if (fan_of[vertex] == sides.size()) fan_of[vertex] = fan;
    if (fan_of[vertex] != fan) return error_at(fmt::format("vertex {}", vertex), "joins triangles that share no edge");
  }
  return {};
}

}  // namespace limber::eval
