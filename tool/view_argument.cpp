// SPDX-License-Identifier: Apache-2.0
#include "tool/view_argument.h"

#include <array>
#include <charconv>

#include "tool/exit.h"
#include "tool/numbers.h"
#include "tool/picture_argument.h"
#include "tool/ranges.h"

namespace limber::tool {
namespace {

constexpr const char* kGroup = "VIEW";

// An option with a text that `accept` understands, or not.
template <class Accept>
void add_text(CLI::App& app, const std::string& name, const std::string& description, const std::string& type,
              const std::string& complaint, Accept accept) {
  app.add_option_function<std::string>(
         name,
         [name, complaint, accept](const std::string& text) {
           if (!accept(text)) throw CLI::ValidationError(name, text + " is " + complaint);
         },
         description)
      ->type_name(type)
      ->group(kGroup);
}

bool parse_point(std::string_view text, Vec3d& point) {
  std::array<double, 3> numbers{};
  if (!parse_numbers(text, numbers)) return false;
  point = {numbers[0], numbers[1], numbers[2]};
  return true;
}

std::optional<Focus> parse_focus(std::string_view text) {
  std::array<double, 4> numbers{};
  if (!parse_numbers(text, numbers) || !(numbers[3] > 0)) return std::nullopt;
  return Focus{.center = {numbers[0], numbers[1], numbers[2]}, .radius = numbers[3]};
}

// x:FROM:TO
std::optional<Along> parse_along(std::string text) {
  const std::size_t middle = text.find(':', 2);
  if (text.size() < 2 || text[0] < 'x' || text[0] > 'z' || text[1] != ':' || middle == std::string::npos)
    return std::nullopt;
  text[middle] = ',';
  std::array<double, 2> ends{};
  if (!parse_numbers(std::string_view(text).substr(2), ends) || ends[0] == ends[1]) return std::nullopt;
  return Along{.axis = text[0] - 'x', .from = ends[0], .to = ends[1]};
}

}  // namespace

void declare_looking(CLI::App& app, ViewArgument& argument) {
  add_text(app, "--eye", "where it is seen from", "X,Y,Z", "no point; three numbers, as in 1,0.5,3",
           [&](const std::string& text) { return parse_point(text, argument.eye.emplace()); });
  add_text(app, "--target", "what the eye looks at", "X,Y,Z", "no point; three numbers, as in 1,0.5,3",
           [&](const std::string& text) { return parse_point(text, argument.target.emplace()); });
  app.add_option("--fov", argument.fov_degrees, "vertical field of view of the eye, in degrees")
      ->check(in_range(1, 120))
      ->type_name("DEG")
      ->capture_default_str()
      ->group(kGroup);
  app.add_option("--pixels", argument.pixels,
                 "as coarse as this error allows, in pixels of the eye's picture; with --vertices or --triangles: no "
                 "finer than that")
      ->check(in_range(1e-3, 1e6))
      ->type_name("N")
      ->group(kGroup);
  app.add_flag("--estimate", argument.estimate, "estimate the error in pixels instead of proving it: many times faster")
      ->group(kGroup);
  app.add_option("--silhouettes", argument.silhouettes, "how many times finer on silhouettes")
      ->check(in_range(1, 1000))
      ->type_name("F")
      ->capture_default_str()
      ->group(kGroup);
  app.add_option("--facing-away", argument.facing_away, "how many times coarser where the surface faces away")
      ->check(in_range(1, 1000))
      ->type_name("F")
      ->capture_default_str()
      ->group(kGroup);
  add_text(app, "--focus", "finer in a ball, given by its middle and radius", "X,Y,Z,R",
           "no ball; three numbers and a radius, as in 1,0.5,3,0.2", [&](const std::string& text) {
             argument.focus = parse_focus(text);
             return argument.focus.has_value();
           });
  add_text(app, "--along", "finer towards one end of an axis, as in x:-0.5:0.5 for finest at -0.5", "x:FROM:TO",
           "no axis with two ends; as in x:-0.5:0.5", [&](const std::string& text) {
             argument.along = parse_along(text);
             return argument.along.has_value();
           });
}

void declare_curvature(CLI::App& app, ViewArgument& argument) {
  app.add_option("--curvature", argument.curvature, "as coarse as bends of so many degrees allow; four-face files only")
      ->check(in_range(0, 180))
      ->type_name("DEG")
      ->group(kGroup);
}

void declare_eye_picture(CLI::App& app, ViewArgument& argument) {
  add_text(app, "--up", "what points up in the eye's picture (0,1,0)", "X,Y,Z", "no direction; three numbers",
           [&](const std::string& text) { return parse_point(text, argument.up); });
  add_text(app, "--size", "of the eye's picture (1200x900)", "WxH",
           "no size; two numbers from 1 to 16384, as in 1200x900",
           [&](const std::string& text) { return parse_size(text, argument.width, argument.height); });
}

std::optional<View> view_of(const ViewArgument& argument, std::optional<CutOptions>& cut) {
  if (argument.eye.has_value() != argument.target.has_value())
    throw UsageError("--eye and --target go together: where it is seen from, and what is looked at");
  if (!argument.eye && (argument.pixels || argument.silhouettes > 1 || argument.facing_away > 1))
    throw UsageError("--pixels, --silhouettes and --facing-away need an eye: --eye X,Y,Z --target X,Y,Z");
  if (!argument.eye && !argument.focus && !argument.along) return std::nullopt;
  if (argument.eye && cut && cut->by == CutBy::kError)
    throw UsageError("with --eye errors are in pixels: --pixels N in place of --error");
  if (!cut && !argument.pixels)
    throw UsageError("a view needs a size or an error: --pixels, --vertices, --triangles, or --error without an eye");
  if (cut && cut->by == CutBy::kLevel) throw UsageError("--level leaves nothing to choose for a view");
  if (cut && argument.pixels) {
    cut->enough = *argument.pixels;
  } else if (argument.pixels) {
    cut = CutOptions{.by = CutBy::kError, .error_bound = *argument.pixels};
  }
  cut->hold = !argument.estimate;
  View view{.width = static_cast<Index>(argument.width),
            .height = static_cast<Index>(argument.height),
            .silhouettes = argument.silhouettes,
            .facing_away = argument.facing_away,
            .focus = argument.focus,
            .along = argument.along};
  if (argument.eye)
    view.camera = {
        .eye = *argument.eye, .target = *argument.target, .up = argument.up, .fov_degrees = argument.fov_degrees};
  return view;
}

}  // namespace limber::tool
