// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "eval/comparison.h"
#include "eval/parallel_for.h"
#include "limber/clip/mesh_sequence_writer.h"
#include "tool/clip_argument.h"
#include "tool/method_argument.h"
#include "tool/output_argument.h"
#include "tool/progress.h"
#include "tool/sampling_argument.h"
#include "tool/verb.h"

namespace limber::tool {
namespace {

struct Arguments {
  ClipArgument clip;
  MethodArgument method;
  bool measure = false;
  eval::DistanceOptions distance;
  OutputArgument output;
};

struct Size {
  Index vertices = 0, triangles = 0;
};

Size size_of(const eval::Approximation& made) {
  return {static_cast<Index>(made.positions.size()), static_cast<Index>(made.triangles.size())};
}

// A clip that is being simplified.
struct Work {
  std::unique_ptr<ClipReader> clip;
  eval::MethodOptions options;
  eval::SeenFrames seen;
  std::optional<MeshSequenceWriter> writer;

  Result<void> write(const eval::Approximation& made) {
    if (!writer) return {};
    return writer->write({.triangles = made.triangles, .positions = made.positions});
  }
};

Result<Work> begin(const Arguments& arguments, std::span<const eval::MethodInfo* const> methods, Progress& progress,
                   Console& console) {
  Work work;
  auto clip = open_any_clip(arguments.clip);
  if (!clip) return clip.error();
  work.clip = std::move(*clip);
  for (const eval::MethodInfo* info : methods) {
    const Result<void> supported = info->supports(work.clip->mesh());
    if (!supported) return unsupported(arguments.clip.specification, *info, supported.error());
  }
  work.options = method_options(arguments.method, work.clip->mesh());
  if (!arguments.output.path.empty()) {
    const std::uint32_t frame_count = work.clip->frame_count().value_or(1);
    if (arguments.output.is_standard_output() && frame_count > 1)
      throw UsageError(
          fmt::format("standard output takes one frame, and there are {}; see --first and --last", frame_count));
    auto writer = open_mesh_output(arguments.output, work.clip->first_frame_number(), console);
    if (!writer) return writer.error();
    work.writer.emplace(std::move(*writer));
  }
  progress.start("reading", work.clip->frame_count());
  Result<eval::SeenFrames> seen =
      eval::SeenFrames::read(*work.clip, methods, arguments.method.base_frames,
                             [&](std::uint32_t frames_read) { return progress.update(frames_read); });
  if (!seen) return seen.error();
  work.seen = std::move(*seen);
  progress.start("simplifying", work.clip->frame_count());
  return work;
}

// One method, without measuring. Where frames do not depend on each other several are made at the same time.
Result<std::vector<Size>> simplify_clip(Work& work, const eval::MethodInfo& info, unsigned threads,
                                        Progress& progress) {
  struct Lane {
    std::unique_ptr<eval::Method> method;
    std::vector<Vec3f> positions;
    eval::Approximation made;
  };
  const Mesh& mesh = work.clip->mesh();
  std::vector<Lane> lanes(info.frames_are_independent ? threads : 1);
  const auto seen = work.seen.of(info);
  for (Lane& lane : lanes) {
    lane.method = info.create(work.options);
    lane.method->begin(mesh, seen);
    lane.positions.resize(mesh.vertex_count);
  }
  std::vector<Size> sizes;
  for (bool ended = false; !ended;) {
    std::size_t count = 0;
    while (count < lanes.size()) {
      const Result<bool> more = work.clip->read(lanes[count].positions);
      if (!more) return more.error();
      if ((ended = !*more)) break;
      ++count;
    }
    eval::parallel_for(count, [&](std::size_t i) { lanes[i].method->frame(lanes[i].positions, lanes[i].made); });
    for (std::size_t i = 0; i < count; ++i) {
      if (Result<void> written = work.write(lanes[i].made); !written) return written.error();
      sizes.push_back(size_of(lanes[i].made));
    }
    if (!progress.update(sizes.size())) return interruption();
  }
  return sizes;
}

Result<eval::Comparison> compare_methods(Work& work, std::span<const eval::MethodInfo* const> methods,
                                         const eval::DistanceOptions& distance, Progress& progress) {
  const Mesh& mesh = work.clip->mesh();
  eval::Comparison comparison(methods, work.options,
                              {.distance = distance, .first_frame_number = work.clip->first_frame_number()});
  comparison.begin(mesh, work.seen);
  std::vector<Vec3f> positions(mesh.vertex_count);
  for (std::uint64_t done = 0;;) {
    const Result<bool> more = work.clip->read(positions);
    if (!more) return more.error();
    if (!*more) return comparison;
    if (Result<void> added = comparison.add(positions); !added) return added.error();
    if (Result<void> written = work.write(comparison.contenders().front().approximation); !written)
      return written.error();
    if (!progress.update(++done)) return interruption();
  }
}

Json asked_json(const eval::MethodOptions& options) {
  if (options.vertices > 0) return {{"vertices", options.vertices}};
  return {{"triangles", options.triangles}};
}

std::string asked(const eval::MethodOptions& options) {
  return options.vertices > 0 ? fmt::format("at most {} vertices", options.vertices)
                              : fmt::format("at most {} triangles", options.triangles);
}

std::string range(Index low, Index high) {
  return low == high ? fmt::format("{}", low) : fmt::format("{} to {}", low, high);
}

void report_sizes(const Arguments& arguments, const Work& work, std::span<const Size> sizes, Console& console) {
  const auto [few_vertices, many_vertices] = std::ranges::minmax(sizes, {}, &Size::vertices);
  const auto [few_triangles, many_triangles] = std::ranges::minmax(sizes, {}, &Size::triangles);
  const std::string& method = arguments.method.names.front();
  console.print("{}: {} frame{} by {}, asked for {}: {} vertices, {} triangles\n", arguments.output.path, sizes.size(),
                sizes.size() == 1 ? "" : "s", method, asked(work.options),
                range(few_vertices.vertices, many_vertices.vertices),
                range(few_triangles.triangles, many_triangles.triangles));
  const bool too_large = work.options.vertices > 0 ? many_vertices.vertices > work.options.vertices
                                                   : many_triangles.triangles > work.options.triangles;
  if (too_large && work.options.contract.topology == Topology::kPreserve)
    console.note("the shape's holes and parts allow no fewer; --topology free lets them close");

  Json frames = Json::array();
  std::uint32_t number = work.clip->first_frame_number();
  for (const Size& size : sizes)
    frames.push_back({{"frame", number++}, {"vertices", size.vertices}, {"triangles", size.triangles}});
  Json methods = Json::array();
  methods.push_back({{"method", method}, {"frames", frames}});
  console.report("limber.simplify/1", {{"input", arguments.clip.specification},
                                       {"output", arguments.output.path},
                                       {"asked", asked_json(work.options)},
                                       {"frame_count", sizes.size()},
                                       {"methods", methods}});
}

void report_comparison(const Arguments& arguments, const Work& work, const eval::Comparison& comparison,
                       Console& console) {
  if (!arguments.output.path.empty()) console.note("{}: written", arguments.output.path);
  console.print("{} frame{}, {}; distances and flicker in % of the diagonal\n",
                comparison.contenders().front().frames.size(),
                comparison.contenders().front().frames.size() == 1 ? "" : "s", asked(work.options));
  console.print("{}", comparison_table(comparison));
  if (!console.conventions.json) return;
  console.report_with({{"input", arguments.clip.specification},
                       {"output", arguments.output.path.empty() ? Json(nullptr) : Json(arguments.output.path)},
                       {"asked", asked_json(work.options)}},
                      comparison_json(comparison));
}

Result<Exit> simplify_verb(const Arguments& arguments, Console& console) {
  const std::vector<const eval::MethodInfo*> methods = chosen_methods(arguments.method);
  const bool writes = !arguments.output.path.empty();
  if (!writes && !arguments.measure) throw UsageError("where should the result go? give -o, or --measure, or both");
  if (methods.size() > 1 && !arguments.measure) throw UsageError("several methods are for --measure");
  if (methods.size() > 1 && writes) throw UsageError("-o takes one method's result; give one --method");

  Progress progress(console, "reading");
  Result<Work> work = begin(arguments, methods, progress, console);
  if (!work) return work.error();
  if (arguments.measure) {
    const Result<eval::Comparison> comparison = compare_methods(*work, methods, arguments.distance, progress);
    if (!comparison) return comparison.error();
    progress.finish();
    if (work->writer) {
      if (Result<void> finished = work->writer->finish(); !finished) return finished.error();
    }
    report_comparison(arguments, *work, *comparison, console);
    return Exit::kDone;
  }
  const Result<std::vector<Size>> sizes = simplify_clip(*work, *methods.front(), console.conventions.threads, progress);
  if (!sizes) return sizes.error();
  progress.finish();
  if (Result<void> finished = work->writer->finish(); !finished) return finished.error();
  report_sizes(arguments, *work, *sizes, console);
  return Exit::kDone;
}

}  // namespace

Action declare_simplify(CLI::App& app) {
  const auto arguments = std::make_shared<Arguments>();
  declare_clip(app, arguments->clip);
  declare_method(app, arguments->method);
  declare_mesh_output(app, arguments->output,
                      "'out/%04d.obj' (or .ply, .off), or for a single mesh out.obj, or - for standard output");
  app.add_flag("--measure", arguments->measure,
               "distance to the input, flicker, changed triangles, quadric error and processor time");
  declare_sampling(app, arguments->distance);
  return [arguments](Console& console) { return simplify_verb(*arguments, console); };
}

}  // namespace limber::tool
