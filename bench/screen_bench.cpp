// SPDX-License-Identifier: Apache-2.0
// limber_screen_bench STREAM TRIALS: whether cuts by a number of pixels keep what they promise. Each trial is a random
// camera, a random number of pixels from 0.5 to 4, and a frame of the stream; the cut goes from one to the next, as a
// viewer's would. What is measured is eval/screen_error.h, with 200,000 samples on each surface.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fmt/format.h>

#include "eval/screen_error.h"
#include "eval/stream_levels.h"
#include "limber/view/triangle_list.h"

namespace {

using namespace limber;

// Of sorted values.
double quantile(const std::vector<double>& values, double share) {
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

void print(const char* name, std::vector<double> values) {
  std::sort(values.begin(), values.end());
  fmt::print("{:<34} {:>8.3f} {:>8.3f} {:>8.3f} {:>8.3f}\n", name, values.front(), quantile(values, 0.5),
             quantile(values, 0.95), values.back());
}

int run(const char* path, unsigned trial_count) {
  auto opened = eval::StreamLevels::open(path);
  if (!opened) return fmt::print(stderr, "{}\n", opened.error().line()), 1;
  eval::StreamLevels& levels = **opened;
  const Mesh& mesh = levels.mesh();
  Cut cut(mesh, levels.state().hierarchy, {.by = CutBy::kError});
  TriangleList list;
  eval::ClosestPointTree original_tree, drawn_tree;
  std::vector<double> shares, to_drawn, to_original, sizes;
  std::size_t kept = 0;
  std::uint64_t seed = 0;
  for (unsigned trial = 0; trial < trial_count; ++trial) {
    const auto frame = static_cast<std::uint32_t>(std::uint64_t{trial} * levels.available_frames() / trial_count);
    if (const auto there = levels.go_to(frame); !there) return fmt::print(stderr, "{}\n", there.error().line()), 1;
    const FrameState& state = levels.state();
    const eval::Surface original{mesh.triangles, std::span(state.positions).first(mesh.vertex_count)};
    original_tree.rebuild(original);
    for (;;) {  // until the camera sees something
      const View view = eval::random_view(eval::bounding_box(original), ++seed);
      const double pixels = eval::random_pixels(seed);
      cut.set_options({.by = CutBy::kError, .error_bound = static_cast<float>(pixels)});
      cut.update(mesh, state, view);
      list_triangles(mesh, cut.labels(), list);
      const eval::Surface drawn{list.triangles, state.positions};
      drawn_tree.rebuild(drawn);
      const eval::ScreenError error =
          eval::measure_screen_error(original, original_tree, drawn, drawn_tree, view, 200'000);
      if (error.point_count < 1000) continue;
      kept += error.largest() <= pixels;
      shares.push_back(error.largest() / pixels);
      to_drawn.push_back(error.to_drawn / pixels);
      to_original.push_back(error.to_original / pixels);
      sizes.push_back(cut.vertex_count());
      break;
    }
  }
  fmt::print("{} trials, {} frames of {} vertices: the promise is kept in {}\n\n", trial_count,
             levels.available_frames(), mesh.vertex_count, kept);
  fmt::print("{:<34} {:>8} {:>8} {:>8} {:>8}\n", "measured, promised = 1", "least", "median", "p95", "largest");
  print("from the original to what is drawn", to_drawn);
  print("from what is drawn to the original", to_original);
  print("the larger of the two", shares);
  std::sort(sizes.begin(), sizes.end());
  fmt::print("vertices drawn {:>28.0f} {:>8.0f} {:>8.0f} {:>8.0f}\n", sizes.front(), quantile(sizes, 0.5),
             quantile(sizes, 0.95), sizes.back());
  return kept == trial_count ? 0 : 4;
}

}  // namespace

int main(int argument_count, char** arguments) {
  const int trial_count = argument_count == 3 ? std::atoi(arguments[2]) : 0;
  if (trial_count < 1) return fmt::print(stderr, "usage: limber_screen_bench STREAM TRIALS\n"), 2;
  return run(arguments[1], static_cast<unsigned>(trial_count));
}
