// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "eval/level_choice.h"
#include "eval/report/charts.h"
#include "eval/report/style.h"
#include "limber/clip/input_file.h"
#include "limber/clip/output_file.h"
#include "limber/stream/decoder.h"
#include "limber/view/blend.h"
#include "limber/view/cut.h"
#include "limber/view/triangle_list.h"
#include "tool/level_argument.h"
#include "tool/output_argument.h"
#include "tool/progress.h"
#include "tool/ranges.h"
#include "tool/stream_file.h"
#include "tool/verb.h"
#include "tool/view_argument.h"

namespace limber::tool {
namespace {

constexpr Index kDefaultVertexCount = 800;

struct Arguments {
  std::string file;
  Index vertex_count = 0;  // 0: none asked for
  ViewArgument view;
  double turn = 0;  // of the eye, degrees per frame
  std::uint32_t repeat_count = 1;
  Index blend = 0;
  OutputArgument output;  // of a chart; no path: none
};

// Milliseconds of every step played: [repetitions x frames after the first].
struct Times {
  std::vector<double> hierarchy, cut, list;  // decoding swaps; choosing the nodes; listing their triangles
  std::vector<double> moving;                // the last two together
  std::vector<double> blend;                 // blending the changes between frames, where asked for
  std::vector<double> update;                // all of these together
  std::vector<double> positions;             // decoding positions and errors of all nodes
  std::vector<double> copy;                  // copying the positions of the finest vertices, for comparison
};

struct Quantiles {
  double median = 0, p95 = 0;
};

double median(std::vector<double>& values) {
  std::sort(values.begin(), values.end());
  return values[(values.size() - 1) / 2];
}

// The median of each frame's repetitions: what a frame takes, not what else the machine did. `values`:
// [repetitions x frames].
std::vector<double> frame_medians(const std::vector<double>& values, std::size_t repeat_count) {
  const std::size_t frame_count = values.size() / repeat_count;
  std::vector<double> frames(frame_count), repetitions(repeat_count);
  for (std::size_t frame = 0; frame < frame_count; ++frame) {
    for (std::size_t i = 0; i < repeat_count; ++i) repetitions[i] = values[i * frame_count + frame];
    frames[frame] = median(repetitions);
  }
  return frames;
}

// Over the frames.
Quantiles quantiles(const std::vector<double>& values, std::size_t repeat_count) {
  if (values.empty()) return {};
  std::vector<double> frames = frame_medians(values, repeat_count);
  const double middle = median(frames);
  return {middle, frames[(frames.size() * 95 + 99) / 100 - 1]};
}

// The update of every frame and its steps.
std::string update_chart(const Times& times, std::size_t repeat_count, std::uint32_t first_frame) {
  eval::FrameChart chart{.name = "Time to update each frame",
                         .y_title = "milliseconds",
                         .first_frame = first_frame + 1,  // the first frame is no update
                         .series = {}};
  const auto add = [&](const char* name, const std::vector<double>& values) {
    chart.series.push_back({name, {chart.series.size()}, frame_medians(values, repeat_count)});
  };
  add("update", times.update);
  add("hierarchy", times.hierarchy);
  add("cut", times.cut);
  if (!times.blend.empty()) add("blend", times.blend);
  add("triangles", times.list);
  return eval::standalone(eval::draw_frame_chart(chart, eval::Room::kWide));
}

// Around the target and the way up.
Vec3d turned(const Camera& camera, double degrees) {
  const double angle = degrees * (3.14159265358979323846 / 180), cosine = std::cos(angle), sine = std::sin(angle);
  const Vec3d axis = camera.up * (1 / length(camera.up)), arm = camera.eye - camera.target;
  return camera.target + arm * cosine + cross(axis, arm) * sine + axis * (dot(axis, arm) * (1 - cosine));
}

class Stopwatch {
 public:
  // Milliseconds since the last call.
  double lap() {
    const Clock::time_point now = Clock::now();
    const double time = std::chrono::duration<double, std::milli>(now - last_).count();
    last_ = now;
    return time;
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point last_ = Clock::now();
};

class Playing {
 public:
  // `turn`: of the camera of the view, in degrees per frame.
  Playing(Decoder decoder, const eval::LevelChoice& level, double turn)
      : decoder_(std::move(decoder)), level_(level), turn_(turn) {
    decoder_.prepare(state_);
    copy_.resize(decoder_.mesh().vertex_count);
  }

  // Plays all frames. The first, whose memory is not warm and which is always a key, is not among the times.
  Result<void> run(Times& times, Progress& progress, std::uint32_t frames_done);

  const Decoder& decoder() const { return decoder_; }
  std::size_t triangle_count() const { return list_.triangles.size(); }
  Index vertex_count() const { return active_count_; }
  std::optional<float> seen_error() const { return seen_error_; }

 private:
  Decoder decoder_;
  void update(Cut& cut) const;

  eval::LevelChoice level_;
  double turn_;
  FrameState state_;
  TriangleList list_;
  std::vector<Vec3f> copy_;  // [vertex_count of the mesh]
  Index active_count_ = 0;
  std::optional<float> seen_error_;
};

void Playing::update(Cut& cut) const {
  if (!level_.view) return cut.update(decoder_.mesh(), state_);
  View view = *level_.view;
  if (view.camera) view.camera->eye = turned(*view.camera, turn_ * state_.frame);
  cut.update(decoder_.mesh(), state_, view);
}

Result<void> Playing::run(Times& times, Progress& progress, std::uint32_t frames_done) {
  const Mesh& mesh = decoder_.mesh();
  if (Result<void> decoded = decoder_.decode(0, state_); !decoded) return decoded;
  Cut cut(mesh, state_.hierarchy, *level_.cut);
  update(cut);
  std::optional<Blend> blend;
  if (level_.blend > 1) {
    blend.emplace(mesh, state_.hierarchy, BlendOptions{.frames = level_.blend});
    blend->update(state_, cut);
  }
  list_triangles(mesh, cut.labels(), list_);
  for (std::uint32_t frame = 1; frame < decoder_.available_frames(); ++frame) {
    Stopwatch watch;
    if (Result<void> decoded = decoder_.decode_hierarchy(frame, state_); !decoded) return decoded;
    times.hierarchy.push_back(watch.lap());
    if (Result<void> decoded = decoder_.decode_positions(frame, state_); !decoded) return decoded;
    times.positions.push_back(watch.lap());
    update(cut);
    times.cut.push_back(watch.lap());
    if (blend) {
      blend->update(state_, cut);
      times.blend.push_back(watch.lap());
    }
    list_triangles(mesh, blend ? blend->labels() : cut.labels(), list_);
    times.list.push_back(watch.lap());
    std::copy_n(state_.positions.begin(), copy_.size(), copy_.begin());
    times.copy.push_back(watch.lap());
    times.moving.push_back(times.cut.back() + times.list.back());
    times.update.push_back(times.hierarchy.back() + times.cut.back() + times.list.back() +
                           (blend ? times.blend.back() : 0));
    if (!progress.update(frames_done + frame + 1)) return Error{ErrorCode::kCancelled, "", "interrupted"};
  }
  active_count_ = cut.vertex_count();
  if (level_.view) seen_error_ = cut.seen_error();
  return {};
}

// 800 vertices where nothing else is asked for.
eval::LevelChoice level_of(const Arguments& arguments) {
  std::optional<CutOptions> cut;
  if (arguments.vertex_count > 0 || !arguments.view.pixels)
    cut = CutOptions{.by = CutBy::kVertices,
                     .budget = arguments.vertex_count > 0 ? arguments.vertex_count : kDefaultVertexCount};
  const std::optional<View> view = view_of(arguments.view, cut);
  if (arguments.turn != 0 && !(view && view->camera)) throw UsageError("--turn needs an eye that turns: --eye X,Y,Z");
  return {.cut = cut, .view = view, .blend = arguments.blend};
}

Result<Exit> play(const Arguments& arguments, Console& console) {
  const eval::LevelChoice level = level_of(arguments);
  std::optional<OutputFile> drawing;
  if (!arguments.output.path.empty()) {
    if (lower_case_extension(arguments.output.path) != ".svg")
      throw UsageError(fmt::format("the output of play is a chart, so its name must end in .svg, not as {} does",
                                   one_line(arguments.output.path)));
    Result<OutputFile> created = OutputFile::create(arguments.output.path, arguments.output.replace);
    if (!created) return created.error();
    drawing = std::move(*created);
  }
  const Result<StreamFile> file = StreamFile::open(arguments.file);
  if (!file) return file.error();
  Result<Decoder> decoder = open_decoder(*file);
  if (!decoder) return decoder.error();
  const std::uint32_t frame_count = decoder->available_frames();
  if (frame_count == 0)
    return Error{ErrorCode::kTruncated, file->name(), "ends before its first frame is whole; copy it again"};
  Playing playing(std::move(*decoder), level, arguments.turn);
  Times times;
  Progress progress(console, "playing", std::uint64_t{frame_count} * arguments.repeat_count);
  for (std::uint32_t i = 0; i < arguments.repeat_count; ++i) {
    const Result<void> played = playing.run(times, progress, i * frame_count);
    if (!played && played.error().code == ErrorCode::kCancelled) return played.error();
    if (!played) return in_file(file->name(), played.error());
  }
  progress.finish();
  if (drawing) {
    const std::string chart =
        update_chart(times, arguments.repeat_count, playing.decoder().header().first_frame_number);
    if (Result<void> written = drawing->write({chart.data(), chart.size()}); !written) return written.error();
    if (Result<void> committed = drawing->commit(); !committed) return committed.error();
  }

  const Mesh& mesh = playing.decoder().mesh();
  console.print(
      "{}: {} frames of {} vertices, each {} times; the last cut has {} vertices (asked: {}), {} triangles{}\n\n",
      one_line(file->name()), frame_count, mesh.vertex_count, arguments.repeat_count, playing.vertex_count(),
      describe(level.cut, level.view), playing.triangle_count(),
      playing.seen_error() ? fmt::format(", error {:.3g}", *playing.seen_error()) : "");
  console.print("{:<34} {:>10} {:>16}\n", "milliseconds per frame", "median", "95th percentile");
  Json json = {{"file", file->name()},
               {"frames", frame_count},
               {"vertices", mesh.vertex_count},
               {"repeat", arguments.repeat_count},
               {"asked", describe_json(level.cut, level.view)},
               {"turn", arguments.turn},
               {"blend", arguments.blend},
               {"cut_vertices", playing.vertex_count()},
               {"cut_triangles", playing.triangle_count()}};
  const auto row = [&](const char* label, const char* name, const std::vector<double>& values) {
    const Quantiles q = quantiles(values, arguments.repeat_count);
    console.print("{:<34} {:>10.4f} {:>16.4f}\n", label, q.median, q.p95);
    json["milliseconds"][name] = {{"median", q.median}, {"p95", q.p95}};
  };
  row("update: hierarchy, cut, triangles", "update", times.update);
  row("  hierarchy", "hierarchy", times.hierarchy);
  row("  cut", "cut", times.cut);
  if (!times.blend.empty()) row("  blend", "blend", times.blend);
  row("  triangles", "triangles", times.list);
  row("cut and triangles", "moving", times.moving);
  row("positions", "positions", times.positions);
  row("a plain copy of the positions", "copy", times.copy);
  Json& frames = json["frame_update_milliseconds"] = Json::array();
  for (const double time : frame_medians(times.update, arguments.repeat_count)) frames.push_back(time);
  json["update_p95_per_10000_vertices"] =
      quantiles(times.update, arguments.repeat_count).p95 * 10000 / std::max<Index>(1, mesh.vertex_count);
  console.report("limber.play/1", json);
  return Exit::kDone;
}

}  // namespace

Action declare_play(CLI::App& app) {
  const auto arguments = std::make_shared<Arguments>();
  app.add_option("FILE", arguments->file, "a stream; - for standard input")->required();
  app.add_option("--vertices", arguments->vertex_count, "cut to at most so many vertices (800)")
      ->check(in_range(1, kNone - 1.0))
      ->type_name("N");
  declare_looking(app, arguments->view);
  declare_eye_picture(app, arguments->view);
  app.add_option("--turn", arguments->turn, "turn the eye around its target by so many degrees per frame")
      ->check(in_range(-360, 360))
      ->type_name("DEG")
      ->group("VIEW");
  app.add_option("--repeat", arguments->repeat_count, "play so many times; a frame's time is the median of its times")
      ->check(in_range(1, 10000))
      ->type_name("N")
      ->capture_default_str();
  app.add_option("--blend", arguments->blend, "blend each change between frames over so many frames; 0: not at all")
      ->check(CLI::Range(0u, 1000u))
      ->type_name("N")
      ->capture_default_str();
  declare_output(app, arguments->output, "a chart of the update of every frame: update.svg", false);
  return [arguments](Console& console) { return play(*arguments, console); };
}

}  // namespace limber::tool
