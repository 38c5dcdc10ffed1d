// SPDX-License-Identifier: Apache-2.0
// limber_distance_bench ORIGINAL APPROXIMATION [ORIGINAL APPROXIMATION ...]: measure_distance() beside an independent
// program, in both directions, on one thread.
//
//   limber   measure_distance() with its defaults, trees included: RMS, and the processor time of both directions
//   CGAL     as many points, drawn uniformly by area with <random>, and their squared distances by CGAL's AABB tree:
//   RMS,
//            how far limber's is from it, and the processor time of this direction
//   largest  of the differences between the two trees' distances at limber's own points
//
// RMS and differences of distances are in percent of the diagonal of the original's bounding box.
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <random>
#include <tbb/global_control.h>
#include <vector>

#include "eval/distance.h"
#include "eval/methods/thread_time.h"
#include "limber/clip/mesh_file.h"

namespace {

using namespace limber;
using eval::Surface;
using Kernel = CGAL::Simple_cartesian<double>;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

Kernel::Point_3 to_cgal(const Vec3d& p) { return {p.x, p.y, p.z}; }

// CGAL's predicates need triangles with a normal.
Triangles triangles_of(const Surface& surface) {
  Triangles triangles;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    if (length(eval::area_vector(surface, t)) > 0)
      triangles.push_back(
          {to_cgal(corner(surface, t, 0)), to_cgal(corner(surface, t, 1)), to_cgal(corner(surface, t, 2))});
  }
  return triangles;
}

struct Independent {
  double rms = 0, seconds = 0;
};

Independent measure_by_cgal(const Surface& from, const Surface& to, std::size_t sample_count) {
  const eval::ThreadTimer timer;
  const Triangles triangles = triangles_of(to);
  Tree tree(triangles.begin(), triangles.end());
  tree.accelerate_distance_queries();
  std::vector<double> areas;
  for (std::size_t t = 0; t < from.triangles.size(); ++t) areas.push_back(length(eval::area_vector(from, t)));
  std::discrete_distribution<std::size_t> any_triangle(areas.begin(), areas.end());
  std::uniform_real_distribution<double> unit;
  std::mt19937_64 random(42);
  double sum = 0;
  for (std::size_t i = 0; i < sample_count; ++i) {
    const std::size_t t = any_triangle(random);
    const double root = std::sqrt(unit(random)), along = unit(random);
    sum += tree.squared_distance(to_cgal(point_at(from, t, {1 - root, root * (1 - along), root * along})));
  }
  return {std::sqrt(sum / static_cast<double>(sample_count)), timer.seconds()};
}

double largest_difference(const Surface& from, const Surface& to, std::size_t sample_count) {
  const Triangles triangles = triangles_of(to);
  Tree tree(triangles.begin(), triangles.end());
  tree.accelerate_distance_queries();
  const eval::ClosestPointTree ours(to);
  std::vector<eval::SurfaceSample> samples(sample_count);
  eval::AreaSamples(from, sample_count, eval::SampleOptions{}.seed).fill(0, samples);
  double largest = 0;
  for (const eval::SurfaceSample& sample : samples) {
    const Vec3d p = point_at(from, sample.triangle, sample.barycentric);
    const double difference =
        std::sqrt(ours.closest(p).squared_distance) - std::sqrt(tree.squared_distance(to_cgal(p)));
    largest = std::max(largest, std::abs(difference));
  }
  return largest;
}

void compare(const std::string& name, const Surface& original, const Surface& approximation) {
  const eval::ThreadTimer timer;
  const eval::Distance ours = measure_distance(original, approximation);
  const double seconds = timer.seconds();
  const double percent = 100 / ours.diagonal;
  const auto line = [&](const char* direction, const eval::OneWayDistance& way, const Surface& from,
                        const Surface& to) {
    const Independent theirs = measure_by_cgal(from, to, way.sample_count);
    const double rms = theirs.rms * percent;
    fmt::print("{:<44} {:<16} {:>8} {:>9.6f} {:>8.2f} {:>9.6f} {:>7.2f} {:>8.2f} {:>9.1e}\n", name, direction,
               way.sample_count, way.rms, seconds, rms, 100 * (way.rms / rms - 1), theirs.seconds,
               largest_difference(from, to, way.sample_count) * percent);
    std::fflush(stdout);
  };
  line("to approximation", ours.to_approximation, original, approximation);
  line("to original", ours.to_original, approximation, original);
}

}  // namespace

int main(int argc, char** argv) {
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  fmt::print("{:<44} {:<16} {:>8} {:>9} {:>8} {:>9} {:>7} {:>8} {:>9}\n", "pair", "direction", "samples", "limber",
             "both s", "CGAL", "diff. %", "s", "largest");
  for (int i = 1; i + 1 < argc; i += 2) {
    const auto original = read_mesh(argv[i]), approximation = read_mesh(argv[i + 1]);
    for (const auto* file : {&original, &approximation}) {
      if (!*file) return fmt::print(stderr, "{}\n", file->error().line()), 3;
    }
    const std::string name = argv[i + 1];
    compare(name.substr(name.find_last_of('/') + 1), {original->mesh.triangles, original->positions},
            {approximation->mesh.triangles, approximation->positions});
  }
}
