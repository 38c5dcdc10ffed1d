// SPDX-License-Identifier: Apache-2.0
#include "eval/clip_measure.h"
#include "eval/clip_report.h"
#include "tool/frames_argument.h"
#include "tool/level_argument.h"
#include "tool/open_source.h"
#include "tool/progress.h"
#include "tool/sampling_argument.h"
#include "tool/verb.h"

namespace limber::tool {
namespace {

struct Arguments {
  ClipArgument original;
  ClipArgument approximation;
  LevelArgument level;
  eval::DistanceOptions distance;
};

Error frame_error(const std::string& clip, std::uint64_t number, std::string what) {
  return {ErrorCode::kBadInput, fmt::format("{}, frame {}", clip, number), std::move(what)};
}

Error count_mismatch(const Arguments& arguments, std::uint64_t count, bool original_ended) {
  const std::string& shorter =
      original_ended ? arguments.original.specification : arguments.approximation.specification;
  const std::string& longer = original_ended ? arguments.approximation.specification : arguments.original.specification;
  return {ErrorCode::kMismatch, shorter,
          fmt::format("has {} frame{}, {} has more; --first and --last choose frames of both", count,
                      count == 1 ? "" : "s", longer)};
}

Result<eval::ClipMeasure> measure_all(const Arguments& arguments, Console& console) {
  auto original = open_original(arguments.original);
  if (!original) return original.error();
  auto approximation = open_any_meshes(arguments.approximation,
                                       {.cut = cut_options(arguments.level, false), .blend = arguments.level.blend});
  if (!approximation) return approximation.error();
  const std::uint32_t first_number = (*original)->first_frame_number();
  eval::ClipMeasure measure({.distance = arguments.distance, .first_frame_number = first_number});
  eval::SourceMesh original_mesh, approximation_mesh;
  std::vector<Triangle> ids;
  Progress progress(console, "measuring", (*original)->frame_count());
  for (std::uint32_t done = 0;; ++done) {
    const Result<bool> more_original = (*original)->read(original_mesh);
    if (!more_original) return more_original.error();
    const Result<bool> more_approximation = (*approximation)->read(approximation_mesh);
    if (!more_approximation) return more_approximation.error();
    if (*more_original != *more_approximation) return count_mismatch(arguments, done, !*more_original);
    if (!*more_original) return measure;

    const eval::Surface from{original_mesh.triangles, original_mesh.positions};
    const eval::Surface to{approximation_mesh.triangles, approximation_mesh.positions};
    const std::uint64_t number = std::uint64_t{first_number} + done;
    if (!(bounding_box(from).diagonal() > 0)) {
      return frame_error(arguments.original.specification, number,
                         "all of its triangles lie in one point: there is nothing to measure against");
    }
    if (to.triangles.empty()) {
      return frame_error(arguments.approximation.specification, number, "has no triangles: nothing can be measured");
    }
    ids.clear();
    if (!approximation_mesh.nodes.empty()) {
      ids = approximation_mesh.triangles;
      for (Triangle& triangle : ids) {
        for (Index& corner : triangle) corner = approximation_mesh.nodes[corner];
      }
    }
    measure.add(from, to, ids);
    if (!progress.update(done + 1)) return interruption();
  }
}

Result<Exit> run_measure(const Arguments& arguments, Console& console) {
  Result<eval::ClipMeasure> measure = measure_all(arguments, console);
  if (!measure) return measure.error();
  console.print("{}{}", report_table(*measure), sampling_line(*measure));
  if (console.conventions.json) {
    console.report_with(
        {{"original", arguments.original.specification}, {"approximation", arguments.approximation.specification}},
        report_json(*measure));
  }
  return Exit::kDone;
}

}  // namespace

Action declare_measure(CLI::App& app) {
  const auto arguments = std::make_shared<Arguments>();
  declare_clip(app, arguments->original, "ORIGINAL");
  app.add_option("APPROXIMATION", arguments->approximation.specification,
                 "anything of as many frames; its connectivity may change from frame to frame. Of a .limber stream "
                 "the level asked for, or the finest")
      ->required();
  app.add_option("--approximation-mesh", arguments->approximation.options.mesh, "as --mesh, of the approximation")
      ->type_name("FILE");
  declare_level(app, arguments->level);
  declare_sampling(app, arguments->distance);
  return [arguments](Console& console) {
    copy_part(arguments->original.options, arguments->approximation.options);
    return run_measure(*arguments, console);
  };
}

}  // namespace limber::tool
