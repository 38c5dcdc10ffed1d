// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <system_error>

#include "limber/base/portable_math.h"
#include "limber/clip/input_file.h"
#include "limber/clip/output_file.h"
#include "limber/stream/build_stream.h"
#include "tool/clip_argument.h"
#include "tool/four_face.h"
#include "tool/frame_bytes.h"
#include "tool/output_argument.h"
#include "tool/progress.h"
#include "tool/ranges.h"
#include "tool/recluster_argument.h"
#include "tool/stream_file.h"
#include "tool/verb.h"

namespace limber::tool {
namespace {

struct Arguments {
  ClipArgument clip;
  OutputArgument output;
  BuildStreamOptions options;
  bool is_four_face = false;
  std::optional<double> crease_degrees;
  bool dry_run = false;
};

void check_arguments(const Arguments& arguments, const Console& console) {
  if (arguments.is_four_face && (!arguments.options.hierarchy.level_sizes.empty() || arguments.dry_run))
    throw UsageError("--levels and --dry-run are for --structure hierarchy");
  if (arguments.crease_degrees && !arguments.is_four_face) throw UsageError("--creases needs --structure four-face");
  const std::vector<Index>& sizes = arguments.options.hierarchy.level_sizes;
  if (std::adjacent_find(sizes.begin(), sizes.end(), std::less_equal<>()) != sizes.end())
    throw UsageError("--levels must get smaller from one to the next, as in 3200,800");
  if (arguments.output.is_standard_output()) {
    if (console.conventions.json) throw UsageError("-o - and --json both want standard output; give one of them up");
    return;
  }
  const std::filesystem::path path(arguments.output.path);
  std::error_code ignored;
  const auto status = std::filesystem::status(path, ignored);
  const bool is_device = std::filesystem::exists(status) && !std::filesystem::is_regular_file(status);
  if (lower_case_extension(path) != ".limber" && !is_device)
    throw UsageError(fmt::format("the output of build is a stream, so its name must end in .limber, not as {} does",
                                 one_line(arguments.output.path)));
}

std::string_view stage_name(BuildStage stage) {
  switch (stage) {
    case BuildStage::kChoosing:
      return "reading";
    case BuildStage::kBase:
      return "first levels";
    case BuildStage::kFrames:
      return "building";
  }
  return "";
}

Result<BuildReport> build_with_progress(ClipReader& clip, const BuildStreamOptions& options, const ByteSink& sink,
                                        Console& console) {
  Progress progress(console, "reading");
  BuildStage stage = BuildStage::kChoosing;
  return build_stream(clip, options, sink, [&](const BuildProgress& now) {
    if (now.stage != stage || now.frames_done == 1) progress.start(stage_name(now.stage), now.frame_count);
    stage = now.stage;
    return progress.update(now.frames_done);
  });
}

// The level that a size asked for became: the smallest that is not below it.
Index achieved(Index asked, const std::vector<Index>& level_sizes) {
  Index best = level_sizes.front();
  for (const Index size : level_sizes)
    if (size >= asked) best = size;
  return best;
}

void print_report(const Arguments& arguments, const BuildReport& report, const Mesh& mesh, Console& console) {
  const BuildStreamOptions& options = arguments.options;
  console.print("{}: {} frames, {} vertices, {} triangles; {} bytes, {:.2f} bits per vertex and frame\n",
                arguments.output.path, report.frame_count, mesh.vertex_count, mesh.triangles.size(),
                report.stream_bytes, bits_per_vertex(report.stream_bytes, mesh.vertex_count, report.frame_count));
  console.print("levels        {}\n", fmt::join(report.level_sizes, " "));
  for (const Index asked : options.hierarchy.level_sizes) {
    const Index size = achieved(asked, report.level_sizes);
    if (size == asked) continue;
    console.note("asked for a level of {} vertices, the nearest is {}{}", asked, size,
                 asked < mesh.vertex_count && options.hierarchy.contract.topology == Topology::kPreserve
                     ? ": isolated vertices and the topology keep more (see --topology free)"
                     : "");
  }
  console.print("swaps         {:.1f} per frame (95th percentile {:.0f})\n", report.swaps.mean, report.swaps.p95);
  if (report.restart_count > 0)
    console.print("made anew     {} {}, where the clip jumps\n", report.restart_count,
                  report.restart_count == 1 ? "time" : "times");
  console.print("bytes         {}\n", frame_bytes_line(report.bytes, report.frame_count));
  console.print("first levels  from {} frames; growth exponent {:.3f}{}\n", report.base_frame_count, report.growth,
                options.recluster.growth ? " (given)" : "");
  const BuildReport::Times& s = report.seconds;
  console.print("seconds       {:.2f}: first levels {:.2f}, reading {:.2f}, reclustering {:.2f}, encoding {:.2f}\n",
                s.total, s.base, s.reading, s.reclustering, s.encoding);
}

Json to_json(const Arguments& arguments, const BuildReport& report, const Mesh& mesh) {
  const BuildStreamOptions& options = arguments.options;
  const BuildReport::Times& s = report.seconds;
  Json asked = {{"branching", options.hierarchy.branching}, {"levels", options.hierarchy.level_sizes}};
  asked["tolerance"] = options.encoder.lossless ? 0.0 : options.encoder.tolerance;
  asked["key_interval"] = options.encoder.key_interval;
  return {{"output", arguments.output.path},
          {"frames", report.frame_count},
          {"vertices", mesh.vertex_count},
          {"triangles", mesh.triangles.size()},
          {"asked", asked},
          {"levels", report.level_sizes},
          {"base_frames", report.base_frame_count},
          {"growth", report.growth},
          {"swaps", {{"mean", report.swaps.mean}, {"p95", report.swaps.p95}}},
          {"restarts", report.restart_count},
          {"bytes", report.stream_bytes},
          {"bytes_per_frame", frame_bytes_json(report.bytes, report.frame_count)},
          {"bits_per_vertex_and_frame", bits_per_vertex(report.stream_bytes, mesh.vertex_count, report.frame_count)},
          {"seconds",
           {{"base", s.base},
            {"reading", s.reading},
            {"reclustering", s.reclustering},
            {"encoding", s.encoding},
            {"total", s.total}}}};
}

// Reads no more than the first frame.
Result<Exit> say_what_would_be_done(const Arguments& arguments, ClipReader& clip, Console& console) {
  const Mesh& mesh = clip.mesh();
  std::vector<Vec3f> positions(mesh.vertex_count);
  const Result<bool> read = clip.read(positions);
  if (!read) return read.error();
  std::vector<Index> levels = level_targets(mesh.vertex_count, arguments.options.hierarchy);
  levels.insert(levels.begin(), mesh.vertex_count);
  const std::optional<std::uint32_t> frame_count = clip.frame_count();
  console.print("{}: would have {} frames, {} vertices, {} triangles; nothing is written\n", arguments.output.path,
                frame_count ? fmt::format("{}", *frame_count) : "all", mesh.vertex_count, mesh.triangles.size());
  console.print("levels        {} or near\n", fmt::join(levels, " "));
  console.report("limber.build_plan/1", {{"output", arguments.output.path},
                                         {"frames", frame_count ? Json(*frame_count) : Json(nullptr)},
                                         {"vertices", mesh.vertex_count},
                                         {"triangles", mesh.triangles.size()},
                                         {"levels", levels}});
  return Exit::kDone;
}

// Those that both kinds of files have in common.
BuildFourKOptions four_face_options(const Arguments& arguments, const Console& console) {
  BuildFourKOptions options;
  options.structure.threads = console.conventions.threads;
  options.structure.quadrics = arguments.options.hierarchy.contract.quadrics;
  options.encoder.tolerance = arguments.options.encoder.tolerance;
  options.encoder.lossless = arguments.options.encoder.lossless;
  options.base_frames = arguments.options.base_frames;
  if (arguments.crease_degrees) options.crease_cosine = portable_cos(*arguments.crease_degrees * (kPi / 180));
  return options;
}

Result<Exit> build(Arguments arguments, Console& console) {
  check_arguments(arguments, console);
  auto clip = open_any_clip(arguments.clip);
  if (!clip) return clip.error();
  std::optional<OutputFile> file;
  ByteSink sink = [&](std::span<const std::byte> bytes) {
    const std::span text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    return file ? file->write(text) : console.write_bytes(text);
  };
  if (arguments.output.is_standard_output()) {
    console.results_go_to_standard_error();
  } else {
    Result<OutputFile> created = OutputFile::create(arguments.output.path, arguments.output.replace);
    if (!created) return created.error();
    file = std::move(*created);
  }
  // Here, so that an output that is in the way is found out, too.
  if (arguments.dry_run) return say_what_would_be_done(arguments, **clip, console);
  if (arguments.is_four_face) {
    const Result<void> made =
        build_four_face(**clip, four_face_options(arguments, console), sink, arguments.output.path, console);
    if (!made && made.error().code == ErrorCode::kCancelled) return interruption();
    if (!made) return made.error().where.empty() ? in_file(arguments.clip.specification, made.error()) : made.error();
    if (!file) return Exit::kDone;
    if (Result<void> committed = file->commit(); !committed) return committed.error();
    return Exit::kDone;
  }
  arguments.options.threads = console.conventions.threads;
  const Result<BuildReport> report = build_with_progress(**clip, arguments.options, sink, console);
  if (!report && report.error().code == ErrorCode::kCancelled) return interruption();
  if (!report)
    return report.error().where.empty() ? in_file(arguments.clip.specification, report.error()) : report.error();
  if (file) {
    if (Result<void> committed = file->commit(); !committed) return committed.error();
  }
  print_report(arguments, *report, (*clip)->mesh(), console);
  console.report("limber.build/1", to_json(arguments, *report, (*clip)->mesh()));
  return Exit::kDone;
}

void declare_levels(CLI::App& app, BuildStreamOptions& options) {
  app.add_option("--branching", options.hierarchy.branching, "how many times fewer vertices each level has")
      ->check(in_range(1.05, 1e6))
      ->type_name("X")
      ->capture_default_str();
  app.add_option("--levels", options.hierarchy.level_sizes,
                 "exact vertex counts of levels, as in 3200,800; --branching adds those between and beyond")
      ->delimiter(',')
      ->check(in_range(1, kNone - 1.0))
      ->type_name("N,N");
  static const std::map<std::string, Topology> kTopologies = {{"preserve", Topology::kPreserve},
                                                              {"free", Topology::kFree}};
  app.add_option(
         "--topology", options.hierarchy.contract.topology,
         "preserve: every level is homeomorphic to the input; free: holes may close and necks collapse (preserve)")
      ->transform(CLI::CheckedTransformer(kTopologies, CLI::ignore_case).description(""))
      ->type_name("preserve|free");
  app.add_option("--base-frames", options.base_frames, "the first levels are made for so many frames, spread evenly")
      ->check(in_range(1, 1000))
      ->type_name("N")
      ->capture_default_str();
}

void declare_encoding(CLI::App& app, EncoderOptions& options) {
  CLI::Option* const tolerance =
      app.add_option("--tolerance", options.tolerance,
                     "how far a stored position may lie from that of the input, as a share of the diagonal")
          ->check(in_range(1e-9, 0.1))
          ->type_name("X")
          ->capture_default_str();
  app.add_flag("--lossless", options.lossless, "store every position bit by bit; not with --tolerance")
      ->excludes(tolerance);
  app.add_option("--keys", options.key_interval, "a frame that can be decoded alone, every so many frames")
      ->check(in_range(1, 1e6))
      ->type_name("N")
      ->capture_default_str();
}

}  // namespace

Action declare_build(CLI::App& app) {
  const auto arguments = std::make_shared<Arguments>();
  declare_clip(app, arguments->clip);
  declare_output(app, arguments->output, "the stream: out.limber, or - for standard output");
  app.add_flag("--dry-run", arguments->dry_run, "look at the first frame, say what would be done, and write nothing");
  static const std::map<std::string, bool> kStructures = {{"hierarchy", false}, {"four-face", true}};
  app.add_option(
         "--structure", arguments->is_four_face,
         "hierarchy: levels that follow the clip; four-face: one structure of local operations, whose meshes may "
         "be finer in some places than in others (hierarchy)")
      ->transform(CLI::CheckedTransformer(kStructures, CLI::ignore_case).description(""))
      ->type_name("hierarchy|four-face");
  app.add_option("--creases", arguments->crease_degrees,
                 "four-face: keep edges as lines where the normals beside them turn by more than so many degrees")
      ->check(in_range(0, 180))
      ->type_name("DEG");
  declare_levels(app, arguments->options);
  declare_recluster(app, arguments->options.recluster, "OPTIONS");
  declare_encoding(app, arguments->options.encoder);
  return [arguments](Console& console) { return build(*arguments, console); };
}

}  // namespace limber::tool
