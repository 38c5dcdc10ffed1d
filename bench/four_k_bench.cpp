// SPDX-License-Identifier: Apache-2.0
// limber_four_k_bench MESH [MESH ...]: times building a 4-K mesh down to 1 % of the triangles beside meshopt_simplify
// to as many, in turn, and prints both medians and the median of the ratios of neighbouring runs, which a noisy machine
// disturbs least. Then times a front of about 20,000 triangles of the whole 4-K mesh (half the mesh where that is less)
// that follows an eye on a circle around it, half a degree at a time: with a limit on the errors as they are seen, and
// with a budget. All times are those of the processor, but for two threads beside one.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <meshoptimizer.h>
#include <vector>

#include "limber/clip/mesh_file.h"
#include "limber/contract/bounds.h"
#include "limber/fourface/build_four_k.h"
#include "limber/fourface/front_request.h"

namespace {

struct Milliseconds {
  double processor;  // what others do on the machine is not in it, but for the caches
  double wall;
};

template <class Work>
Milliseconds time(Work&& work) {
  const auto wall = std::chrono::steady_clock::now();
  const std::clock_t processor = std::clock();
  work();
  return {1e3 * static_cast<double>(std::clock() - processor) / CLOCKS_PER_SEC,
          std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - wall).count()};
}

double quantile(std::vector<double> values, double share) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

void time_building(const limber::MeshFile& file) {
  constexpr int kRunCount = 11;
  const auto& mesh = file.mesh;
  limber::FourKOptions options;
  options.triangles = static_cast<limber::Index>(mesh.triangles.size() / 100);
  std::vector<unsigned> indices(3 * mesh.triangles.size());
  std::vector<double> ours, theirs, ratios, of_two;
  std::size_t ours_left = 0, theirs_left = 0;
  const auto build = [&](unsigned threads) {
    options.threads = threads;
    return time([&] {
      const limber::FourKMesh made = limber::build_four_k(mesh, file.positions, options);
      ours_left = static_cast<std::size_t>(std::count(made.destroyer.begin(), made.destroyer.end(), limber::kNone));
    });
  };
  const auto meshopt = [&] {
    return time([&] {
      float error = 0;
      theirs_left =
          meshopt_simplify(indices.data(), mesh.triangles[0].data(), 3 * mesh.triangles.size(), &file.positions[0].x,
                           file.positions.size(), sizeof(limber::Vec3f), 3 * ours_left, 1e9f, 0, &error) /
          3;
    });
  };
  for (int run = 0; run <= kRunCount; ++run) {
    const Milliseconds one = build(1), peer = meshopt(), two = build(2);
    if (run == 0) continue;  // warms up
    ours.push_back(one.processor), theirs.push_back(peer.processor);
    ratios.push_back(one.processor / peer.processor), of_two.push_back(two.wall / one.wall);
  }
  std::printf("  build: %zu triangles to %zu in %.1f ms, meshopt_simplify to %zu in %.1f; ratio %.2f\n",
              mesh.triangles.size(), ours_left, quantile(ours, .5), theirs_left, quantile(theirs, .5),
              quantile(ratios, .5));
  std::printf("         two threads take %.2f of the time of one\n", quantile(of_two, .5));
}

void time_fronts(const limber::MeshFile& file) {
  const limber::FourKMesh mesh = limber::build_four_k(file.mesh, file.positions, {});
  const auto size = std::min<limber::Index>(20000, mesh.finest_count / 2);
  const limber::Box box = limber::bounds(file.positions);
  const limber::Vec3d middle = (box.low + box.high) * .5;
  const double radius = 1.2 * length(box.high - box.low);
  limber::FrontRequest request;
  const auto look_from = [&](int step) {
    const double angle = step * .5 * 3.14159265358979 / 180;
    const limber::Vec3d eye = middle + limber::Vec3d{std::cos(angle), .2, std::sin(angle)} * radius;
    request.view = limber::Viewpoint{.eye = eye, .target = middle};
  };
  limber::Front front(mesh);
  for (const bool budget : {false, true}) {
    look_from(0);
    double low = 0, high = 100;
    for (int i = 0; i < 30 && !budget; ++i) {
      request.pixels = (low + high) / 2;
      move_front(front, mesh, file.positions, request);
      (front.triangles().size() > size ? low : high) = *request.pixels;
    }
    if (budget) request.pixels.reset(), request.triangles = size;
    std::vector<double> times, changes, sizes;
    for (int step = 0; step <= 720; ++step) {
      look_from(step);
      const double took = time([&] { move_front(front, mesh, file.positions, request); }).processor;
      if (step == 0) continue;
      times.push_back(took);
      changes.push_back(front.changes());
      sizes.push_back(static_cast<double>(front.triangles().size()));
    }
    std::printf(
        "  front, %-6s %5.0f triangles, %3.0f operations a step: median %.3f ms, 95th percentile %.3f, most %.3f\n",
        budget ? "budget" : "limit", quantile(sizes, .5), quantile(changes, .5), quantile(times, .5),
        quantile(times, .95), quantile(times, 1));
  }
}

}  // namespace

int main(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    const auto file = limber::read_mesh(argv[i]);
    if (!file) return std::fprintf(stderr, "%s\n", file.error().line().c_str()), 3;
    std::printf("%s\n", argv[i]);
    time_building(*file);
    std::fflush(stdout);
    time_fronts(*file);
    std::fflush(stdout);
  }
}
