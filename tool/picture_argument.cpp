// SPDX-License-Identifier: Apache-2.0
#include "tool/picture_argument.h"

#include <charconv>
#include <vector>

#include "limber/clip/input_file.h"

namespace limber::tool {
namespace {

constexpr int kLargestSide = 16384;

// An option with a text that `accept` understands, or not.
template <class Accept>
void add_text(CLI::App& app, PictureArgument& argument, const std::string& name, const std::string& description,
              const std::string& type, const std::string& complaint, Accept accept) {
  app.add_option_function<std::string>(
         name,
         [&argument, name, complaint, accept](const std::string& text) {
           argument.given = true;
           if (!accept(text)) throw CLI::ValidationError(name, text + " is " + complaint);
         },
         description)
      ->type_name(type)
      ->group("PICTURES");
}

template <class Set>
void add_flag(CLI::App& app, PictureArgument& argument, const std::string& name, const std::string& description,
              Set set) {
  app.add_flag_callback(
         name, [&argument, set] { argument.given = true, set(); }, description)
      ->group("PICTURES");
}

}  // namespace

bool parse_size(std::string_view text, int& width, int& height) {
  const std::size_t cross = text.find('x');
  if (cross == std::string_view::npos) return false;
  const auto parse = [](std::string_view digits, int& value) {
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    return error == std::errc{} && end == digits.data() + digits.size() && value >= 1 && value <= kLargestSide;
  };
  return parse(text.substr(0, cross), width) && parse(text.substr(cross + 1), height);
}

bool is_picture(std::string_view path) { return lower_case_extension(path) == ".png"; }

void declare_view(CLI::App& app, PictureArgument& argument) {
  eval::PictureOptions& options = argument.options;
  add_text(app, argument, "--view",
           "front, back, left, right, side, top, three-quarter, or degrees around and above, as in 40,14", "VIEW",
           "no view; give a name, or two numbers of degrees as in 40,14", [&](const std::string& text) {
             const std::optional<eval::View> view = eval::parse_view(text);
             if (view) options.view = *view;
             argument.view_given = true;
             return view.has_value();
           });
  add_text(app, argument, "--up", "the axis that points up: y or z (y)", "AXIS", "neither y nor z",
           [&](const std::string& text) {
             options.up = text == "z" ? eval::UpAxis::kZ : eval::UpAxis::kY;
             return text == "y" || text == "z";
           });
}

void declare_picture(CLI::App& app, PictureArgument& argument) {
  eval::PictureOptions& options = argument.options;
  add_flag(app, argument, "--wireframe", "with the edges of the triangles", [&] { options.wireframe = true; });
  add_flag(app, argument, "--flat", "flat shading", [&] { options.shading = eval::Shading::kFlat; });
  add_flag(app, argument, "--error-colors", "colours for the distance to the original, with a bar that explains them",
           [&] { options.error_colors = true; });
  add_text(app, argument, "--error-range", "where the colours end, in percent of the diagonal; otherwise to suit",
           "PCT", "no positive number", [&](const std::string& text) {
             double value = 0;
             const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
             options.error_range = value;
             return error == std::errc{} && end == text.data() + text.size() && value > 0 && value < 1e6;
           });
  add_flag(app, argument, "--side-by-side",
           "the original, the level, the level with its edges, and error colours where asked for",
           [&] { options.side_by_side = true; });
  add_text(app, argument, "--original", "the original; otherwise the finest level of the stream", "CLIP",
           "no name of a clip", [&](const std::string& text) {
             argument.original.specification = text;
             return !text.empty();
           });
  add_text(app, argument, "--size", "of the picture, or of each of several side by side (1200x900)", "WxH",
           "no size; two numbers from 1 to 16384, as in 1200x900",
           [&](const std::string& text) { return parse_size(text, options.width, options.height); });
  declare_view(app, argument);
  add_text(app, argument, "--background", "white, black, transparent, or #rrggbb (white)", "COLOR",
           "no colour; give white, black, transparent, or #rrggbb", [&](const std::string& text) {
             const std::optional<eval::Rgba8> color = eval::parse_color(text);
             if (color) options.background = *color;
             return color.has_value();
           });
  add_flag(app, argument, "--no-ground", "no shadow below", [&] { options.ground = false; });
  add_text(app, argument, "--fit", "what the picture is large enough for: the whole clip, or the frame", "WHAT",
           "neither clip nor frame", [&](const std::string& text) {
             argument.fit = text == "clip" ? Fit::kClip : Fit::kFrame;
             return text == "clip" || text == "frame";
           });
}

ViewArgument with_picture(ViewArgument view, const PictureArgument& picture) {
  view.width = picture.options.width;
  view.height = picture.options.height;
  view.up = picture.options.up == eval::UpAxis::kZ ? Vec3d{0, 0, 1} : Vec3d{0, 1, 0};
  return view;
}

std::optional<Camera> camera_of(const std::optional<View>& view, const PictureArgument& picture) {
  if (!view || picture.view_given) return std::nullopt;
  return view->camera;
}

}  // namespace limber::tool
