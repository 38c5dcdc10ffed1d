// SPDX-License-Identifier: Apache-2.0
// Kircher & Garland 2005: the hierarchy of the first frame follows the clip by swaps and is cut in every frame, as
// `limber build` and a viewer do it.
#include <algorithm>
#include <cmath>

#include "eval/methods/factories.h"
#include "eval/methods/follower.h"
#include "limber/base/portable_math.h"
#include "limber/hierarchy/build.h"

namespace limber::eval {
namespace {

// Levels of which one has exactly `size` nodes: above it each has 1/branching of the one below; between it and the
// finest stand as many, evenly spaced, as come nearest to that.
std::vector<Index> levels_around(Index vertex_count, Index size, double branching) {
  std::vector<Index> sizes;
  const double ratio = static_cast<double>(vertex_count) / size;
  if (ratio > 1) {
    const double steps = std::max(1.0, std::round(portable_log(ratio) / portable_log(branching)));
    for (double step = 1; step < steps; ++step)
      sizes.push_back(
          static_cast<Index>(std::lround(vertex_count * portable_exp(-step / steps * portable_log(ratio)))));
    sizes.push_back(size);
  }
  for (double above = size / branching; above >= kSmallestLevel; above /= branching)
    sizes.push_back(static_cast<Index>(std::lround(above)));
  return sizes;
}

class Multilevel final : public Method {
 public:
  explicit Multilevel(const MethodOptions& options) : options_(options) {}

  void begin(const Mesh& mesh, std::span<const std::span<const Vec3f>> seen) override {
    BuildOptions build{
        .branching = options_.branching, .level_sizes = options_.level_sizes, .contract = options_.contract};
    if (build.level_sizes.empty() && options_.vertices > 0) {
      build.level_sizes = levels_around(mesh.vertex_count, options_.vertices, options_.branching);
    }
    ReclusterOptions recluster = as_contracted(options_.recluster, options_.contract);
    recluster.restart.tries_first = seen.size() > 1;
    follower_.emplace(mesh, build_hierarchy(mesh, seen, build), recluster, cut_to_size(options_), options_.blend);
  }

  void frame(std::span<const Vec3f> positions, Approximation& out) override { follower_->frame(positions, out); }

 private:
  MethodOptions options_;
  std::optional<Follower> follower_;
};

}  // namespace

std::unique_ptr<Method> make_multilevel(const MethodOptions& options) { return std::make_unique<Multilevel>(options); }

}  // namespace limber::eval
