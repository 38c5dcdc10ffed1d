// SPDX-License-Identifier: Apache-2.0
// meshopt_simplify on every frame, as an engine would call it: the result is made of vertices of the input.
//
// It takes a number of triangles. For a number of vertices:
//
//   triangles = those of the input - 2 for each vertex too many, as on a closed surface
//   a few times: simplify the input; more or fewer triangles by 2 for each vertex too few or too many
//   keep the largest that is not too large
//
// Which clusters its vertices stand for it does not tell, and their quadric error is therefore not known. The version
// of Debian 12, 0.18, cannot place vertices anew (meshopt_simplifyWithUpdate).
#include <algorithm>
#include <cstdint>
#include <meshoptimizer.h>
#include <span>
#include <utility>
#include <vector>

#include "eval/methods/thread_time.h"
#include "eval/peers/factories.h"
#include "limber/base/triangles.h"

namespace limber::eval {
namespace {

constexpr float kAnyError = 1e9f;  // times the extent of the mesh
constexpr int kTries = 8;

struct Attempt {
  std::vector<unsigned> corners;
  Index vertex_count = 0;
  double seconds = 0;
};

class Meshoptimizer final : public Method {
 public:
  explicit Meshoptimizer(const MethodOptions& options) : options_(options) {}

  void begin(const Mesh& mesh, std::span<const std::span<const Vec3f>>) override {
    mesh_ = &mesh;
    corners_.clear();
    for (const Triangle& triangle : mesh.triangles) corners_.insert(corners_.end(), triangle.begin(), triangle.end());
    vertex_count_ = count_vertices(corners_);
  }

  void frame(std::span<const Vec3f> positions, Approximation& out) override {
    const Attempt made =
        options_.triangles > 0 ? simplify(positions, options_.triangles) : simplify_to_vertices(positions);
    out.adapt_seconds = made.seconds;

    const ThreadTimer extracting;
    out.triangles.resize(made.corners.size() / 3);
    for (std::size_t i = 0; i < made.corners.size(); ++i) out.triangles[i / 3][i % 3] = made.corners[i];
    std::vector<Index> place;
    renumber(out.triangles, mesh_->vertex_count, out.nodes, place);
    out.positions.clear();
    for (const Index vertex : out.nodes) out.positions.push_back(positions[vertex]);
    out.extract_seconds = extracting.seconds();
    out.clusters.clear();
  }

 private:
  Index count_vertices(std::span<const unsigned> corners) const {
    std::vector<bool> used(mesh_->vertex_count, false);
    Index count = 0;
    for (const unsigned vertex : corners) {
      if (!used[vertex]) ++count;
      used[vertex] = true;
    }
    return count;
  }

  Attempt simplify(std::span<const Vec3f> positions, std::size_t triangle_count) const {
    Attempt made;
    made.corners.resize(corners_.size());
    const ThreadTimer timer;
    made.corners.resize(meshopt_simplify(made.corners.data(), corners_.data(), corners_.size(), &positions[0].x,
                                         positions.size(), sizeof(Vec3f), 3 * triangle_count, kAnyError, 0, nullptr));
    made.seconds = timer.seconds();
    made.vertex_count = count_vertices(made.corners);
    return made;
  }

  Attempt simplify_to_vertices(std::span<const Vec3f> positions) const {
    const auto asked = static_cast<std::int64_t>(options_.vertices);
    const std::int64_t most = std::ssize(mesh_->triangles);
    std::int64_t triangle_count = most - 2 * (vertex_count_ - asked), last = 0;
    Attempt best;
    best.vertex_count = kNone;
    for (int i = 0; i < kTries; ++i) {
      triangle_count = std::clamp<std::int64_t>(triangle_count, 1, most);
      if (triangle_count == last) break;
      Attempt made = simplify(positions, static_cast<std::size_t>(triangle_count));
      const std::int64_t missing = asked - static_cast<std::int64_t>(made.vertex_count);
      last = std::exchange(triangle_count, triangle_count + 2 * missing);
      const bool fits = missing >= 0, best_fits = best.vertex_count <= options_.vertices;
      if (fits ? !best_fits || made.vertex_count > best.vertex_count
               : !best_fits && made.vertex_count < best.vertex_count)
        best = std::move(made);
    }
    return best;
  }

  MethodOptions options_;
  const Mesh* mesh_ = nullptr;
  std::vector<unsigned> corners_;  // [3 * triangle_count]
  Index vertex_count_ = 0;         // without isolated vertices
};

}  // namespace

std::unique_ptr<Method> make_meshoptimizer(const MethodOptions& options) {
  return std::make_unique<Meshoptimizer>(options);
}

}  // namespace limber::eval
