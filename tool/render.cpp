// SPDX-License-Identifier: Apache-2.0
#include "limber/clip/numbered_name.h"
#include "tool/frames_argument.h"
#include "tool/level_argument.h"
#include "tool/open_source.h"
#include "tool/picture_argument.h"
#include "tool/take_pictures.h"
#include "tool/verb.h"
#include "tool/view_argument.h"

namespace limber::tool {
namespace {

struct Arguments {
  ClipArgument clip;
  LevelArgument level;
  ViewArgument view;
  std::optional<std::uint32_t> frame;
  PictureArgument picture;
  OutputArgument output;
};

bool is_pattern(const std::string& path) {
  return NumberedName::is_pattern(std::filesystem::path(path).filename().string());
}

Result<Exit> render(Arguments arguments, Console& console) {
  const bool many = is_pattern(arguments.output.path) && !arguments.frame;
  if (!is_picture(arguments.output.path)) {
    throw UsageError(fmt::format("{} is no name of a picture; it must end in .png", arguments.output.path));
  }
  if (arguments.frame && is_part(arguments.clip.options))
    throw UsageError("--frame excludes --frames, --first and --last");
  const ClipArgument whole = arguments.clip;
  ClipArgument& shown = arguments.clip;
  ClipArgument original = arguments.picture.original;
  if (original.specification.empty()) original = whole;
  const bool needs_original = arguments.picture.options.error_colors || arguments.picture.options.side_by_side;
  if (needs_original && arguments.picture.original.specification.empty() && !is_stream(whole.specification)) {
    throw UsageError("--original is missing: what should be compared with it?");
  }
  if (!many) {
    if (!arguments.frame) {
      auto source = open_any_meshes(shown);
      if (!source) return source.error();
      arguments.frame = (*source)->first_frame_number();
      if ((*source)->frame_count().value_or(2) > 1) {
        console.note("showing frame {}, the first; --frame N chooses another, '{}' shows all", *arguments.frame,
                     "NAME%04d.png");
      }
    }
    shown.options.first = shown.options.last = arguments.frame;
  }
  copy_part(shown.options, original.options);
  std::optional<CutOptions> cut = cut_options(arguments.level, !many);
  const std::optional<View> view = view_of(with_picture(arguments.view, arguments.picture), cut);
  const eval::LevelChoice level{.cut = cut, .view = view, .blend = arguments.level.blend};
  const bool fits_clip = arguments.picture.fit == Fit::kClip || (arguments.picture.fit == Fit::kSuitable && many);
  const PictureJob job{.options = arguments.picture.options,
                       .open_level = [&] { return open_any_meshes(shown, level); },
                       .open_original = [&] { return open_any_meshes(original); },
                       .open_space = [&] { return open_any_meshes(fits_clip ? whole : shown); },
                       .camera = camera_of(view, arguments.picture)};
  const Result<TakenPictures> taken = take_pictures(job, arguments.output, console);
  if (!taken) return taken.error();

  Json frames = Json::array();
  for (const PicturedFrame& frame : taken->frames) {
    frames.push_back({{"frame", frame.number}, {"vertices", frame.vertices}, {"triangles", frame.triangles}});
  }
  const PicturedFrame& first = taken->frames.front();
  if (taken->frames.size() == 1) {
    console.print("{}: frame {}, {} vertices, {} triangles\n", arguments.output.path, first.number, first.vertices,
                  first.triangles);
  } else {
    console.print("{}: {} pictures, frames {} to {}\n", arguments.output.path, taken->frames.size(), first.number,
                  taken->frames.back().number);
  }
  console.report("limber.render/1", {{"output", arguments.output.path},
                                     {"asked", describe_json(cut, view)},
                                     {"error_range", taken->error_range ? Json(*taken->error_range) : Json(nullptr)},
                                     {"frames", frames}});
  return Exit::kDone;
}

}  // namespace

Action declare_render(CLI::App& app) {
  const auto arguments = std::make_shared<Arguments>();
  declare_clip(app, arguments->clip);
  app.add_option("--frame", arguments->frame, "this frame only, as the source numbers it")->type_name("N");
  declare_level(app, arguments->level);
  declare_looking(app, arguments->view);
  declare_output(app, arguments->output, "image.png, or 'images/%04d.png' for all frames");
  declare_picture(app, arguments->picture);
  return [arguments](Console& console) { return render(*arguments, console); };
}

}  // namespace limber::tool
