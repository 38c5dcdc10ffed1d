// SPDX-License-Identifier: Apache-2.0
// limber_simplify_bench MESH VERTICES [MESH VERTICES ...]: times simplify() beside meshopt_simplify to as many
// triangles, in turn, and prints both medians and the median of the ratios of neighbouring runs, which a noisy machine
// disturbs least.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <meshoptimizer.h>
#include <vector>

#include "limber/clip/mesh_file.h"
#include "limber/contract/contract.h"

namespace {

template <class Work>
double milliseconds(Work&& work) {
  const auto from = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - from).count();
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

}  // namespace

int main(int argc, char** argv) {
  constexpr int kRunCount = 11;
  std::printf("%-34s %9s %9s %12s %14s %6s\n", "mesh", "vertices", "to", "limber ms", "meshopt ms", "ratio");
  for (int i = 1; i + 1 < argc; i += 2) {
    const auto file = limber::read_mesh(argv[i]);
    if (!file) return std::fprintf(stderr, "%s\n", file.error().line().c_str()), 3;
    const auto& [mesh, positions] = *file;
    const auto target = static_cast<limber::Index>(std::atoi(argv[i + 1]));
    std::vector<unsigned> indices(3 * mesh.triangles.size());
    std::vector<double> ours, theirs, ratios;
    limber::Simplified result;
    for (int run = 0; run <= kRunCount; ++run) {
      const double a = milliseconds([&, &m = mesh, &p = positions] { result = limber::simplify(m, p, target, {}); });
      const double b = milliseconds([&, &m = mesh, &p = positions] {
        float error = 0;
        meshopt_simplify(indices.data(), m.triangles[0].data(), 3 * m.triangles.size(), &p[0].x, p.size(),
                         sizeof(limber::Vec3f), 3 * result.mesh.triangles.size(), 1e9f, 0, &error);
      });
      if (run == 0) continue;  // warms up
      ours.push_back(a);
      theirs.push_back(b);
      ratios.push_back(a / b);
    }
    std::printf("%-34s %9u %9u %12.1f %14.1f %6.2f\n", argv[i], mesh.vertex_count, result.mesh.vertex_count,
                median(ours), median(theirs), median(ratios));
    std::fflush(stdout);
  }
}
