// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <filesystem>

#include "eval/four_face_levels.h"
#include "eval/stream_levels.h"
#include "limber/clip/frame_files.h"
#include "limber/clip/mesh_sequence_writer.h"
#include "limber/clip/numbered_name.h"
#include "tool/four_face.h"
#include "tool/frames_argument.h"
#include "tool/level_argument.h"
#include "tool/open_source.h"
#include "tool/output_argument.h"
#include "tool/picture_argument.h"
#include "tool/progress.h"
#include "tool/take_pictures.h"
#include "tool/verb.h"
#include "tool/view_argument.h"

namespace limber::tool {
namespace {

struct Arguments {
  ClipArgument stream;
  std::optional<std::uint32_t> frame;
  LevelArgument level;
  ViewArgument view;
  OutputArgument output;
  PictureArgument picture;
};

// What came out of a frame.
struct Extracted {
  std::uint32_t number = 0;
  Index vertices = 0, triangles = 0;
  double estimated_error = 0;
  std::optional<double> seen_error{};
};

bool is_numbered(const std::string& path) {
  return NumberedName::is_pattern(std::filesystem::path(path).filename().string());
}

// Frames counted from 0, the end not included.
struct Range {
  std::uint32_t first = 0, end = 0, step = 1;

  std::uint32_t size() const { return (end - first + step - 1) / step; }
};

Result<Range> choose_frames(const eval::StreamLevels& levels, const ClipArgument& stream) {
  const std::uint32_t low = levels.first_frame_number();
  const std::uint64_t high = std::uint64_t{low} + levels.available_frames() - 1;
  if (const Result<void> fits = check_range(stream.options, low, high, stream.specification); !fits)
    return fits.error();
  return Range{stream.options.first.value_or(low) - low,
               static_cast<std::uint32_t>(stream.options.last.value_or(high) - low + 1), stream.options.step};
}

Result<void> write(const MeshBuffers& buffers, std::vector<Triangle>& triangles, MeshSequenceWriter& writer) {
  triangles.resize(buffers.triangle_count());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) triangles[t][k] = buffers.indices[3 * t + k];
  }
  return writer.write({.triangles = triangles, .positions = buffers.positions, .normals = buffers.normals});
}

// Makes the level of every frame, and writes it where `output` is a mesh.
Result<std::vector<Extracted>> extract_levels(eval::StreamLevels& levels, const Range& range,
                                              const OutputArgument* output, Console& console) {
  std::optional<MeshSequenceWriter> writer;
  if (output != nullptr) {
    auto created = open_mesh_output(*output, levels.first_frame_number() + range.first, console);
    if (!created) return created.error();
    writer.emplace(std::move(*created));
  }
  Progress progress(console, "extracting", range.size());
  std::vector<Extracted> all;
  std::vector<Triangle> triangles;
  for (std::uint64_t at = range.first; at < range.end; at += range.step) {
    const auto frame = static_cast<std::uint32_t>(at);
    if (const Result<void> there = levels.go_to(frame); !there) return there.error();
    const MeshBuffers& buffers = levels.buffers();
    if (writer) {
      if (const Result<void> written = write(buffers, triangles, *writer); !written) return written.error();
    }
    all.push_back({levels.first_frame_number() + frame, buffers.vertex_count(), buffers.triangle_count(),
                   levels.estimated_error(), levels.seen_error()});
    if (!progress.update(all.size())) return interruption();
  }
  if (writer) {
    if (const Result<void> finished = writer->finish(); !finished) return finished.error();
  }
  return all;
}

// As the input of the pictures: the stream at the level asked for, and what it is compared with.
Result<std::optional<double>> take_pictures_of(const Arguments& arguments, const eval::LevelChoice& level, bool many,
                                               Console& console) {
  ClipArgument original = arguments.picture.original;
  if (original.specification.empty()) original = arguments.stream;
  copy_part(arguments.stream.options, original.options);
  ClipArgument space = arguments.stream;
  const bool fits_clip = arguments.picture.fit == Fit::kClip || (arguments.picture.fit == Fit::kSuitable && many);
  if (fits_clip) space.options = {};
  const PictureJob job{.options = arguments.picture.options,
                       .open_level = [&] { return open_any_meshes(arguments.stream, level); },
                       .open_original = [&] { return open_any_meshes(original); },
                       .open_space = [&] { return open_any_meshes(space); },
                       .camera = camera_of(level.view, arguments.picture)};
  const Result<TakenPictures> taken = take_pictures(job, arguments.output, console);
  if (!taken) return taken.error();
  return taken->error_range;
}

std::string counts(std::span<const Extracted> all, Index Extracted::*count) {
  const auto [low, high] = std::ranges::minmax(all, {}, count);
  return low.*count == high.*count ? fmt::format("{}", low.*count) : fmt::format("{} to {}", low.*count, high.*count);
}

void report(const Arguments& arguments, const eval::LevelChoice& level, std::span<const Extracted> all,
            const std::optional<double>& error_range, Console& console) {
  const auto worst = std::ranges::max(all, {}, &Extracted::estimated_error);
  const std::string frames = all.size() == 1 ? fmt::format("frame {}", all.front().number)
                                             : fmt::format("frames {} to {}", all.front().number, all.back().number);
  console.print("{}{}, asked for {}: {} vertices, {} triangles, error about {:.2g} %{}\n",
                arguments.output.path.empty() ? "" : arguments.output.path + ": ", frames,
                describe(level.cut, level.view), counts(all, &Extracted::vertices), counts(all, &Extracted::triangles),
                worst.estimated_error, all.size() == 1 ? "" : " at most");
  Json list = Json::array();
  for (const Extracted& one : all) {
    list.push_back({{"frame", one.number},
                    {"vertices", one.vertices},
                    {"triangles", one.triangles},
                    {"estimated_error", one.estimated_error},
                    {"seen_error", one.seen_error ? Json(*one.seen_error) : Json(nullptr)}});
  }
  console.report("limber.extract/1",
                 {{"input", arguments.stream.specification},
                  {"output", arguments.output.path.empty() ? Json(nullptr) : Json(arguments.output.path)},
                  {"asked", describe_json(level.cut, level.view)},
                  {"blend", arguments.level.blend},
                  {"unit", "percent of the diagonal of the frame's bounding box"},
                  {"error_range", error_range ? Json(*error_range) : Json(nullptr)},
                  {"frames", list}});
}

void check_usage(const Arguments& arguments) {
  if (!is_stream(arguments.stream.specification)) {
    throw UsageError(
        fmt::format("{} is no .limber stream; \"limber build\" makes one, and \"limber simplify\" takes "
                    "any clip",
                    arguments.stream.specification));
  }
  if (arguments.frame && is_part(arguments.stream.options))
    throw UsageError("--frame excludes --frames, --first and --last");
  const std::string& path = arguments.output.path;
  if (!path.empty() && !arguments.output.is_standard_output() && !is_picture(path) && !mesh_format(path))
    throw UsageError(fmt::format("{} is nothing that limber extracts; the extensions are .obj .ply .off .png", path));
  if (arguments.picture.given && !is_picture(path) && !arguments.view.eye)
    throw UsageError("options of pictures need an output that ends in .png");
}

Result<Exit> extract_verb(Arguments arguments, Console& console) {
  check_usage(arguments);
  ClipOptions& options = arguments.stream.options;
  if (arguments.frame) options.first = options.last = arguments.frame;
  if (eval::is_four_face_file(arguments.stream.specification)) {
    return extract_four_face({arguments.stream, arguments.level, arguments.view, arguments.output, arguments.picture},
                             console);
  }
  if (arguments.view.curvature) throw UsageError("--curvature is for four-face files (build --structure four-face)");
  auto opened = eval::StreamLevels::open(arguments.stream.specification);
  if (!opened) return opened.error();
  eval::StreamLevels& levels = **opened;
  const Result<Range> range = choose_frames(levels, arguments.stream);
  if (!range) return range.error();
  const std::string& path = arguments.output.path;
  const bool many = range->size() > 1;
  if (many && arguments.output.is_standard_output()) {
    throw UsageError(
        fmt::format("standard output takes one frame, and there are {}; choose one with --frame N", range->size()));
  }
  if (many && !path.empty() && !is_numbered(path))
    throw UsageError(
        fmt::format("{} is one file for {} frames; choose one with --frame N, or number the files as in "
                    "'%04d{}'",
                    path, range->size(), std::filesystem::path(path).extension().string()));
  if (const auto promised = levels.frame_count(); promised && *promised > levels.available_frames())
    console.warn("{} is cut off: {} of its {} frames are whole", arguments.stream.specification,
                 levels.available_frames(), *promised);

  std::optional<CutOptions> cut = cut_options(arguments.level, !many);
  const std::optional<View> view = view_of(with_picture(arguments.view, arguments.picture), cut);
  const eval::LevelChoice level{.cut = cut, .view = view, .blend = arguments.level.blend};
  levels.choose(level);
  std::optional<double> error_range;
  const bool pictures = is_picture(path);
  if (pictures) {
    const Result<std::optional<double>> taken = take_pictures_of(arguments, level, many, console);
    if (!taken) return taken.error();
    error_range = *taken;
  }
  const Result<std::vector<Extracted>> all =
      extract_levels(levels, *range, pictures || path.empty() ? nullptr : &arguments.output, console);
  if (!all) return all.error();
  report(arguments, level, *all, error_range, console);
  return Exit::kDone;
}

}  // namespace

Action declare_extract(CLI::App& app) {
  const auto arguments = std::make_shared<Arguments>();
  app.add_option("FILE", arguments->stream.specification, "a .limber stream")->required();
  app.add_option("--frame", arguments->frame, "this frame only, as the source numbers it; otherwise all")
      ->type_name("N");
  declare_frames(app, arguments->stream.options);
  declare_level(app, arguments->level);
  declare_looking(app, arguments->view);
  declare_curvature(app, arguments->view);
  declare_mesh_output(app, arguments->output,
                      "lod.obj (or .ply, .off), 'lod/%04d.obj' for several frames, - for standard output, or a "
                      "picture, lod.png; without it, only the sizes are said");
  declare_picture(app, arguments->picture);
  return [arguments](Console& console) { return extract_verb(*arguments, console); };
}

}  // namespace limber::tool
