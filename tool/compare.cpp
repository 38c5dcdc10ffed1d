// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "eval/comparison.h"
#include "eval/report/report.h"
#include "limber/stream/build_stream.h"
#include "tool/clip_argument.h"
#include "tool/machine.h"
#include "tool/method_argument.h"
#include "tool/output_argument.h"
#include "tool/part_argument.h"
#include "tool/picture_argument.h"
#include "tool/progress.h"
#include "tool/report_folder.h"
#include "tool/sampling_argument.h"
#include "tool/sweep_argument.h"
#include "tool/verb.h"

namespace limber::tool {
namespace {

constexpr std::size_t kPlaceSamples = 20'000;  // on the surface, for the histograms and the worst places
constexpr std::size_t kCloseUps = 4;
constexpr std::string_view kFollower = "multilevel";  // the method whose result is a stream

struct Arguments {
  ClipArgument clip;
  MethodArgument method;
  eval::DistanceOptions distance;
  PictureArgument picture;
  std::vector<std::string> sweep_texts, part_texts;
  std::vector<WantedSweep> sweeps;
  std::vector<eval::PartBall> parts;
  bool figures = false;
  OutputArgument output;
  bool every_method = false;  // none was named
  std::string words;          // the options as they were given, without -o and what concerns pictures
  std::string command;
};

// A clip that is being compared with what methods make of it.
struct Work {
  std::unique_ptr<ClipReader> clip;
  std::vector<const eval::MethodInfo*> methods;
  std::vector<eval::LeftOut> left_out;
  eval::MethodOptions options;
  eval::SeenFrames seen;
  std::uint32_t frame_count = 0;
};

// As a shell needs it.
std::string quoted(const std::string& word) {
  constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=:,./@";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
  std::string result = "'";
  for (const char c : word) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

// What was given on the command line, but for the options named.
std::string words_given(const CLI::App& app, std::initializer_list<std::string_view> without) {
  std::string words;
  for (const CLI::Option* option : app.get_options()) {
    if (option->count() == 0) continue;
    const std::string shown = !option->get_lnames().empty()   ? "--" + option->get_lnames().front()
                              : !option->get_snames().empty() ? "-" + option->get_snames().front()
                                                              : "";
    if (std::find(without.begin(), without.end(), shown) != without.end()) continue;
    const bool is_list = option->get_delimiter() != '\0';
    const std::vector<std::string> given =
        is_list ? std::vector{fmt::format("{}", fmt::join(option->results(), ","))} : option->results();
    for (const std::string& word : given) {
      if (!shown.empty()) words += " " + shown;
      if (option->get_expected_max() > 0) words += " " + quoted(word);
    }
  }
  return words;
}

// The first method is what the others are held against: direct, where it is among them.
std::vector<const eval::MethodInfo*> methods_in_order(MethodArgument& argument) {
  if (argument.names.empty()) {
    for (const eval::MethodInfo& info : eval::methods()) argument.names.emplace_back(info.name);
  }
  std::vector<const eval::MethodInfo*> methods = chosen_methods(argument);
  const auto direct = std::ranges::find(methods, "direct", &eval::MethodInfo::name);
  if (direct != methods.end()) std::rotate(methods.begin(), direct, direct + 1);
  return methods;
}

Result<std::uint32_t> count_frames(ClipReader& clip, Progress& progress) {
  if (clip.frame_count()) return *clip.frame_count();
  std::vector<Vec3f> positions(clip.mesh().vertex_count);
  for (std::uint32_t frames = 0;;) {
    const Result<bool> more = clip.read(positions);
    if (!more) return more.error();
    if (!*more) {
      if (Result<void> done = clip.rewind(); !done) return done.error();
      return frames;
    }
    if (!progress.update(++frames)) return interruption();
  }
}

// Where every method was asked for, those that cannot take the mesh are left out.
Result<void> choose_methods(const Arguments& arguments, std::span<const eval::MethodInfo* const> methods, Work& work) {
  for (const eval::MethodInfo* info : methods) {
    const Result<void> supported = info->supports(work.clip->mesh());
    if (supported) {
      work.methods.push_back(info);
    } else if (arguments.every_method) {
      work.left_out.push_back({std::string(info->name), supported.error().line()});
    } else {
      return unsupported(arguments.clip.specification, *info, supported.error());
    }
  }
  return {};
}

Result<Work> begin(const Arguments& arguments, std::span<const eval::MethodInfo* const> methods, Progress& progress) {
  Work work;
  auto clip = open_any_clip(arguments.clip);
  if (!clip) return clip.error();
  work.clip = std::move(*clip);
  if (Result<void> chosen = choose_methods(arguments, methods, work); !chosen) return chosen.error();
  work.options = method_options(arguments.method, work.clip->mesh());
  progress.start("reading", work.clip->frame_count());
  const Result<std::uint32_t> frame_count = count_frames(*work.clip, progress);
  if (!frame_count) return frame_count.error();
  work.frame_count = *frame_count;
  std::vector<const eval::MethodInfo*> all = work.methods;
  for (const WantedSweep& sweep : arguments.sweeps) all.push_back(sweep.method);
  Result<eval::SeenFrames> seen =
      eval::SeenFrames::read(*work.clip, all, arguments.method.base_frames,
                             [&](std::uint32_t frames_read) { return progress.update(frames_read); });
  if (!seen) return seen.error();
  work.seen = std::move(*seen);
  return work;
}

struct Compared {
  eval::Comparison comparison;
  eval::WorstPlaces places;
  eval::Parts parts;
  eval::KeptFrames kept;
};

Result<Compared> compare_methods(Work& work, const Arguments& arguments, Progress& progress) {
  const eval::DistanceOptions& distance = arguments.distance;
  const Mesh& mesh = work.clip->mesh();
  Compared compared{
      .comparison = eval::Comparison(work.methods, work.options,
                                     {.distance = distance, .first_frame_number = work.clip->first_frame_number()}),
      .places = eval::WorstPlaces(work.methods.size(), kPlaceSamples, distance.samples.seed),
      .parts = eval::Parts(arguments.parts, work.methods.size(), distance.samples.seed),
      .kept = eval::KeptFrames(work.frame_count)};
  progress.start("comparing", work.frame_count);
  if (!progress.update(0)) return interruption();
  compared.comparison.begin(mesh, work.seen);
  std::vector<Vec3f> positions(mesh.vertex_count);
  for (std::uint64_t done = 0;;) {
    const Result<bool> more = work.clip->read(positions);
    if (!more) return more.error();
    if (!*more) return compared;
    if (Result<void> added = compared.comparison.add(positions); !added) return added.error();
    std::vector<eval::Surface> made;
    for (const eval::Contender& contender : compared.comparison.contenders())
      made.push_back({contender.approximation.triangles, contender.approximation.positions});
    const std::vector<std::size_t> worse = compared.places.add({mesh.triangles, positions}, made);
    compared.kept.add(positions, compared.comparison, worse);
    if (Result<void> added = compared.parts.add({mesh.triangles, positions}, made); !added) return added.error();
    if (!progress.update(++done)) return interruption();
  }
}

BuildStreamOptions stream_options(const eval::MethodOptions& method, std::uint32_t base_frames, unsigned threads) {
  BuildStreamOptions options;
  options.hierarchy = {.branching = method.branching, .level_sizes = method.level_sizes, .contract = method.contract};
  if (options.hierarchy.level_sizes.empty() && method.vertices > 0) options.hierarchy.level_sizes = {method.vertices};
  options.recluster = method.recluster;
  options.base_frames = base_frames;
  options.threads = threads;
  return options;
}

Result<BuildReport> encode(ClipReader& clip, const BuildStreamOptions& options, Progress& progress) {
  if (Result<void> done = clip.rewind(); !done) return done.error();
  const ByteSink nowhere = [](std::span<const std::byte>) { return Result<void>{}; };
  progress.start("encoding", clip.frame_count());
  Result<BuildReport> report =
      build_stream(clip, options, nowhere, [&](const BuildProgress& now) { return progress.update(now.frames_done); });
  if (!report && report.error().code == ErrorCode::kCancelled) return interruption();
  return report;
}

// One value of a sweep: the method alone runs through the clip once more.
Result<eval::SweepPoint> try_value(Work& work, const Arguments& arguments, const WantedSweep& sweep, double value,
                                   const eval::Comparison& report, unsigned threads, Progress& progress) {
  eval::MethodOptions options = work.options;
  sweep.value(options) = value;
  eval::Comparison tried(std::span(&sweep.method, 1), options,
                         {.distance = arguments.distance, .first_frame_number = work.clip->first_frame_number()});
  const Mesh& mesh = work.clip->mesh();
  if (Result<void> done = work.clip->rewind(); !done) return done.error();
  progress.start(fmt::format("{} = {:g}", sweep.parameter, value), work.frame_count);
  if (!progress.update(0)) return interruption();
  tried.begin(mesh, work.seen);
  std::vector<Vec3f> positions(mesh.vertex_count);
  for (std::uint64_t done = 0;;) {
    const Result<bool> more = work.clip->read(positions);
    if (!more) return more.error();
    if (!*more) break;
    if (Result<void> added = tried.add(positions); !added) return added.error();
    if (!progress.update(++done)) return interruption();
  }
  eval::SweepPoint point = sweep_point(value, tried, report);
  if (sweep.method->name != kFollower) return point;
  const Result<BuildReport> stream =
      encode(*work.clip, stream_options(options, arguments.method.base_frames, threads), progress);
  if (!stream) return stream.error();
  point.choice_bytes = static_cast<double>(stream->bytes.hierarchy) / stream->frame_count;
  return point;
}

Result<std::vector<eval::Sweep>> run_sweeps(Work& work, const Arguments& arguments, const eval::Comparison& report,
                                            unsigned threads, Progress& progress) {
  std::vector<eval::Sweep> sweeps;
  for (const WantedSweep& wanted : arguments.sweeps) {
    const auto place = std::ranges::find(work.methods, wanted.method) - work.methods.begin();
    eval::Sweep sweep{.parameter = wanted.parameter,
                      .method = wanted.method,
                      .mark = {static_cast<std::size_t>(place)},
                      .used = wanted.value(work.options),
                      .points = {}};
    for (const double value : wanted.values) {
      const Result<eval::SweepPoint> point = try_value(work, arguments, wanted, value, report, threads, progress);
      if (!point) return point.error();
      sweep.points.push_back(*point);
    }
    sweeps.push_back(std::move(sweep));
  }
  return sweeps;
}

std::string build_command(const Arguments& arguments, const BuildStreamOptions& options) {
  std::string command =
      fmt::format("limber build {} --branching {}", quoted(arguments.clip.specification), options.hierarchy.branching);
  if (!options.hierarchy.level_sizes.empty())
    command += fmt::format(" --levels {}", fmt::join(options.hierarchy.level_sizes, ","));
  return command + " -o clip.limber";
}

std::string asked(const eval::MethodOptions& options) {
  return options.vertices > 0 ? fmt::format("at most {} vertices", options.vertices)
                              : fmt::format("at most {} triangles", options.triangles);
}

eval::RunFacts run_facts(const Arguments& arguments, const Work& work, unsigned threads) {
  std::vector<std::string> names;
  for (const eval::MethodInfo* info : work.methods) names.emplace_back(info->name);
  return {.asked = asked(work.options),
          .commands = {arguments.command,
                       fmt::format("limber simplify{} --method {} --measure", arguments.words, fmt::join(names, ","))},
          .version = LIMBER_PROGRAM_VERSION,
          .compiler = compiler_name(),
          .processor = processor_name(),
          .threads = threads,
          .date = today(),
          .distance = arguments.distance,
          .left_out = work.left_out};
}

Result<void> write_files(const eval::Report& report, bool figures, ReportFolder& folder) {
  if (Result<void> written = folder.write(0, report_page(report)); !written) return written;
  // Names of files need not be UTF-8, but JSON must.
  const std::string json = report_json(report).dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
  if (Result<void> written = folder.write(1, json); !written) return written;
  if (Result<void> written = folder.write(2, report_csv(report.comparison)); !written) return written;
  if (figures) {
    for (const eval::ReportFigure& figure : report_figures(report)) {
      if (Result<void> written = folder.add(figure.name, figure.bytes); !written) return written;
    }
  }
  return folder.finish();
}

Result<Exit> compare_verb(Arguments arguments, Console& console) {
  arguments.every_method = arguments.method.names.empty();
  const std::vector<const eval::MethodInfo*> methods = methods_in_order(arguments.method);
  if (arguments.output.is_standard_output())
    throw UsageError("a report is several files: give -o a folder, as in -o report/");
  // Before the work, so that an output that is in the way is found out at once.
  Result<ReportFolder> folder = ReportFolder::create(arguments.output.path, {"index.html", "report.json", "frames.csv"},
                                                     arguments.output.replace);
  if (!folder) return folder.error();

  Progress progress(console, "reading");
  Result<Work> work = begin(arguments, methods, progress);
  if (!work) return work.error();
  for (const eval::LeftOut& left_out : work->left_out)
    console.note("{} is left out, it cannot take this clip: {}", left_out.method, left_out.why);
  const Result<Compared> compared = compare_methods(*work, arguments, progress);
  if (!compared) return compared.error();
  eval::RunFacts run = run_facts(arguments, *work, console.conventions.threads);
  std::optional<BuildReport> stream;
  if (std::ranges::find(work->methods, kFollower, &eval::MethodInfo::name) != work->methods.end()) {
    const BuildStreamOptions options =
        stream_options(work->options, arguments.method.base_frames, console.conventions.threads);
    Result<BuildReport> encoded = encode(*work->clip, options, progress);
    if (!encoded) return encoded.error();
    stream = std::move(*encoded);
    run.commands.push_back(build_command(arguments, options));
  }

  Result<std::vector<eval::Sweep>> sweeps =
      run_sweeps(*work, arguments, compared->comparison, console.conventions.threads, progress);
  if (!sweeps) return sweeps.error();

  const Mesh& mesh = work->clip->mesh();
  const std::size_t method_count = work->methods.size();
  std::vector<std::string> sheet_labels;
  if (arguments.figures) {
    sheet_labels.emplace_back("original");
    for (const eval::MethodInfo* info : work->methods) sheet_labels.emplace_back(info->name);
  }
  progress.start("rendering");
  Result<eval::PictureSet> pictures = take_report_pictures(
      mesh, compared->kept, compared->places, chosen_places(compared->places, method_count, kCloseUps),
      {.view = arguments.picture.options.view,
       .up = arguments.picture.options.up,
       .error_range = eval::report_error_range(compared->places, method_count),
       .parts = &compared->parts,
       .sheet_labels = std::move(sheet_labels)},
      [&](std::size_t done, std::size_t all) {
        const std::size_t per_frame = method_count + 1;
        if (done == 1) progress.start("rendering", all / per_frame);
        return progress.update(done / per_frame);
      });
  if (!pictures && pictures.error().code == ErrorCode::kCancelled) return interruption();
  if (!pictures) return pictures.error();

  const eval::Report report{.comparison = compared->comparison,
                            .places = compared->places,
                            .clip = {.name = arguments.clip.specification,
                                     .vertex_count = mesh.vertex_count,
                                     .triangle_count = mesh.triangles.size(),
                                     .first_frame = work->clip->first_frame_number(),
                                     .frames_per_second = work->clip->frames_per_second()},
                            .run = std::move(run),
                            .storage = storage_rows(mesh, compared->comparison, stream ? &*stream : nullptr),
                            .stream = stream,
                            .pictures = std::move(*pictures),
                            .parts = &compared->parts,
                            .sweeps = std::move(*sweeps)};
  if (Result<void> written = write_files(report, arguments.figures, *folder); !written) return written.error();
  progress.finish();
  console.print("{}: {} frame{} by {} method{}, {}\n{}", folder->path(0).string(), work->frame_count,
                work->frame_count == 1 ? "" : "s", method_count, method_count == 1 ? "" : "s", report.run.asked,
                comparison_table(report.comparison));
  if (console.conventions.json) console.report_with({{"output", arguments.output.path}}, report_json(report));
  return Exit::kDone;
}

}  // namespace

Action declare_compare(CLI::App& app) {
  const auto arguments = std::make_shared<Arguments>();
  declare_clip(app, arguments->clip);
  declare_method(app, arguments->method);
  app.get_option("--method")->required(false);
  declare_output(app, arguments->output,
                 "a folder for index.html, report.json and frames.csv; it is made where missing");
  declare_view(app, arguments->picture);
  declare_sweep(app, arguments->sweep_texts);
  declare_part(app, arguments->part_texts);
  app.add_flag("--figures", arguments->figures,
               "every figure as a file of its own, too: charts as .svg, pictures as .png");
  declare_sampling(app, arguments->distance);
  return [arguments, &app](Console& console) {
    arguments->command = "limber compare" + words_given(app, {});
    arguments->words = words_given(app, {"--method", "--output", "--force", "--view", "--up", "--sweep", "--part",
                                         "--figures", "--json", "--quiet", "-j"});
    arguments->sweeps = wanted_sweeps(arguments->sweep_texts, app);
    arguments->parts = wanted_parts(arguments->part_texts);
    return compare_verb(*arguments, console);
  };
}

}  // namespace limber::tool
