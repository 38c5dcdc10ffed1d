// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include "eval/four_face_levels.h"
#include "limber/clip/frame_files.h"
#include "limber/clip/mesh_sequence_writer.h"
#include "limber/clip/numbered_name.h"
#include "tool/four_face.h"
#include "tool/progress.h"
#include "tool/take_pictures.h"

namespace limber::tool {
namespace {

// The parts of the request that the arguments name, for a picture of this size.
FrontRequest view_request(const ViewArgument& argument, int width, int height) {
  FrontRequest request;
  if (argument.eye.has_value() != argument.target.has_value())
    throw UsageError("--eye and --target go together: where it is seen from, and what is looked at");
  if (argument.pixels && !argument.eye) throw UsageError("--pixels needs an eye: --eye X,Y,Z --target X,Y,Z");
  if (argument.along || argument.estimate || argument.silhouettes > 1 || argument.facing_away > 1)
    throw UsageError("--along, --estimate, --silhouettes and --facing-away are for streams, not for four-face files");
  if (argument.eye) {
    if (*argument.eye == *argument.target) throw UsageError("--eye and --target are the same point");
    Viewpoint view{.eye = *argument.eye, .target = *argument.target};
    view.fov_degrees = argument.fov_degrees;
    view.width = width;
    view.height = height;
    request.view = view;
  }
  if (argument.focus) request.focus = Ball{argument.focus->center, argument.focus->radius};
  if (argument.pixels) request.pixels = static_cast<double>(*argument.pixels);
  return request;
}

eval::FourFaceRequest request_of(const FourFaceExtract& arguments, bool single_frame) {
  const std::optional<CutOptions> cut = cut_options(arguments.level, single_frame);
  if (arguments.level.blend > 0) throw UsageError("--blend is for streams; a four-face file has no vertices between");
  eval::FourFaceRequest request{
      .front = view_request(arguments.view, arguments.picture.options.width, arguments.picture.options.height)};
  if (arguments.level.error) request.error_percent = static_cast<double>(*arguments.level.error);
  request.bend_degrees = arguments.view.curvature;
  request.front.vertices = arguments.level.vertices;
  request.front.triangles = arguments.level.triangles;
  request.front.level = arguments.level.level;
  const bool limited = request.error_percent || request.front.pixels || request.bend_degrees;
  if ((request.front.vertices || request.front.triangles || request.front.level) &&
      (request.front.pixels || request.bend_degrees))
    throw UsageError("--pixels and --curvature exclude --vertices, --triangles and --level");
  const bool nothing = !cut && !limited && !request.front.view && !request.front.focus;
  if (nothing) request.front.level = 0;
  // Fronts compare errors, not their squares.
  const float hysteresis = arguments.level.hysteresis.value_or(single_frame ? 1.0f : CutOptions{}.hysteresis);
  request.hysteresis = std::sqrt(static_cast<double>(hysteresis));
  return request;
}

std::string describe(const eval::FourFaceRequest& request) {
  std::vector<std::string> parts;
  if (request.front.vertices) parts.push_back(fmt::format("at most {} vertices", *request.front.vertices));
  if (request.front.triangles) parts.push_back(fmt::format("at most {} triangles", *request.front.triangles));
  if (request.front.level) parts.push_back(fmt::format("level {}", *request.front.level));
  if (request.error_percent) parts.push_back(fmt::format("an error of at most {:g} %", *request.error_percent));
  if (request.front.pixels) parts.push_back(fmt::format("an error of at most {} pixels", *request.front.pixels));
  if (request.bend_degrees) parts.push_back(fmt::format("bends of at most {} degrees", *request.bend_degrees));
  if (request.front.view) {
    const Vec3d& eye = request.front.view->eye;
    parts.push_back(fmt::format("what is seen from {},{},{}", eye.x, eye.y, eye.z));
  }
  if (request.front.focus) parts.push_back("what is in the focus");
  return fmt::format("{}", fmt::join(parts, ", "));
}

Result<std::vector<ExtractedFront>> extract_frames(eval::FourFaceLevels& levels, const ClipOptions& range,
                                                   const eval::FourFaceRequest& request, const OutputArgument* output,
                                                   Console& console) {
  const std::uint32_t low = levels.first_frame_number();
  const std::uint32_t first = range.first.value_or(low) - low;
  const std::uint32_t end = range.last ? *range.last - low + 1 : levels.available_frames();
  std::optional<MeshSequenceWriter> writer;
  if (output != nullptr) {
    auto created = open_mesh_output(*output, low + first, console);
    if (!created) return created.error();
    writer.emplace(std::move(*created));
  }
  Progress progress(console, "extracting", (end - first + range.step - 1) / range.step);
  std::vector<ExtractedFront> all;
  for (std::uint64_t frame = first; frame < end; frame += range.step) {
    const auto at = static_cast<std::uint32_t>(frame);
    if (const Result<void> there = levels.go_to(at, request); !there) return there.error();
    const eval::SourceMesh& mesh = levels.mesh();
    if (writer) {
      const Result<void> written =
          writer->write({.triangles = mesh.triangles, .positions = mesh.positions, .normals = {}});
      if (!written) return written.error();
    }
    all.push_back({low + at, mesh.positions.size(), mesh.triangles.size(), levels.error()});
    if (!progress.update(all.size())) return interruption();
  }
  if (writer) {
    if (const Result<void> finished = writer->finish(); !finished) return finished.error();
  }
  return all;
}

Result<void> take(const FourFaceExtract& arguments, const eval::FourFaceRequest& request, bool many, Console& console) {
  const std::string& path = arguments.stream.specification;
  const ClipOptions& part = arguments.stream.options;
  eval::FourFaceRequest finest;
  finest.front.level = 0;
  const bool fits_clip = arguments.picture.fit == Fit::kClip || (arguments.picture.fit == Fit::kSuitable && many);
  const ClipOptions space = fits_clip ? ClipOptions{} : part;
  const PictureJob job{.options = arguments.picture.options,
                       .open_level = [&] { return eval::open_four_face_meshes(path, request, part); },
                       .open_original = [&] { return eval::open_four_face_meshes(path, finest, part); },
                       .open_space = [&] { return eval::open_four_face_meshes(path, finest, space); }};
  const Result<TakenPictures> taken = take_pictures(job, arguments.output, console);
  if (!taken) return taken.error();
  return {};
}

std::string range_of(const std::vector<ExtractedFront>& all, std::size_t ExtractedFront::*count) {
  const auto [low, high] = std::ranges::minmax(all, {}, count);
  return low.*count == high.*count ? fmt::format("{}", low.*count) : fmt::format("{} to {}", low.*count, high.*count);
}

}  // namespace

void report_four_face(const FourFaceExtract& arguments, const eval::FourFaceRequest& request,
                      const std::vector<ExtractedFront>& all, Console& console) {
  const std::string frames = all.size() == 1 ? fmt::format("frame {}", all.front().number)
                                             : fmt::format("frames {} to {}", all.front().number, all.back().number);
  const std::optional<double> worst = std::ranges::max(all, {}, &ExtractedFront::error).error;
  console.print("{}{}, asked for {}: {} vertices, {} triangles{}\n",
                arguments.output.path.empty() ? "" : arguments.output.path + ": ", frames, describe(request),
                range_of(all, &ExtractedFront::vertices), range_of(all, &ExtractedFront::triangles),
                worst ? fmt::format(", errors of operations up to {:.2g} %", *worst) : "");
  Json list = Json::array();
  for (const ExtractedFront& one : all) {
    list.push_back({{"frame", one.number},
                    {"vertices", one.vertices},
                    {"triangles", one.triangles},
                    {"operation_error", one.error ? Json(*one.error) : Json(nullptr)}});
  }
  console.report("limber.extract_four_face/1",
                 {{"input", arguments.stream.specification},
                  {"output", arguments.output.path.empty() ? Json(nullptr) : Json(arguments.output.path)},
                  {"asked", describe(request)},
                  {"unit", "percent of the diagonal of the first frame's bounding box"},
                  {"frames", list}});
}

Result<Exit> extract_four_face(const FourFaceExtract& arguments, Console& console) {
  const ClipOptions& part = arguments.stream.options;
  const std::string& path = arguments.output.path;
  const auto file = StreamFile::open(arguments.stream.specification);
  if (!file) return file.error();
  FourKDecoder decoder;
  if (const Result<void> read = decoder.open(file->bytes()); !read) return in_file(file->name(), read.error());
  if (decoder.header().part_count > 1) {
    if (const Result<void> fits = check_range(part, decoder.header().first_frame_number,
                                              decoder.header().first_frame_number, arguments.stream.specification);
        !fits)
      return fits.error();
    return extract_parts(arguments, request_of(arguments, true), *file, decoder, console);
  }
  auto opened = eval::FourFaceLevels::open(arguments.stream.specification);
  if (!opened) return opened.error();
  eval::FourFaceLevels& levels = **opened;
  const std::uint32_t low = levels.first_frame_number();
  const std::uint64_t high = std::uint64_t{low} + levels.available_frames() - 1;
  if (const Result<void> fits = check_range(part, low, high, arguments.stream.specification); !fits)
    return fits.error();
  const bool many = (part.last.value_or(high) - part.first.value_or(low)) / part.step > 0;
  if (many && arguments.output.is_standard_output())
    throw UsageError("standard output takes one frame; choose one with --frame N");
  const std::string name = std::filesystem::path(path).filename().string();
  if (many && !path.empty() && !NumberedName::is_pattern(name))
    throw UsageError(
        fmt::format("{} is one file for several frames; choose one with --frame N, or number the files", path));
  if (!levels.is_whole())
    console.warn("{} is cut off: its finest triangles may be missing", arguments.stream.specification);
  const eval::FourFaceRequest request = request_of(arguments, !many);
  const bool pictures = is_picture(path);
  if (pictures) {
    if (const Result<void> taken = take(arguments, request, many, console); !taken) return taken.error();
  }
  const auto all =
      extract_frames(levels, part, request, pictures || path.empty() ? nullptr : &arguments.output, console);
  if (!all) return all.error();
  report_four_face(arguments, request, *all, console);
  return Exit::kDone;
}

}  // namespace limber::tool
