// SPDX-License-Identifier: Apache-2.0
// Pictures of the frames of a clip, all from one place.
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "eval/camera.h"
#include "eval/closest_point.h"
#include "eval/image.h"
#include "eval/render.h"
#include "eval/surface.h"

namespace limber::eval {

// Where the eye stands, in degrees: around the subject, 0 in front and 90 at its left hand (the right of the picture
// of the front), and above the horizon, -90 to 90.
struct View {
  double azimuth = 40;
  double elevation = 14;

  friend bool operator==(const View&, const View&) = default;
};

// front, back, left, right, side (as right), top, three-quarter, or two numbers, "40,14". Nothing for anything else.
std::optional<View> parse_view(std::string_view text);

// "white", "black", "transparent", or "#rrggbb". Nothing for anything else.
std::optional<Rgba8> parse_color(std::string_view text);

// The axis that points up. In front of the subject lies z where y is up, and -y where z is up.
enum class UpAxis { kY, kZ };

// From the subject towards the eye, unit.
Vec3d direction_to_eye(const View& view, UpAxis up);

struct PictureOptions {
  int width = 1200, height = 900;  // of each tile where there are several
  View view;
  UpAxis up = UpAxis::kY;
  Shading shading = Shading::kSmooth;
  bool wireframe = false;
  double wire_width = 0;              // pixels; 0: to suit the size of the picture
  bool error_colors = false;          // the distance to the original, in percent of its diagonal
  std::optional<double> error_range;  // where the colours end, in percent; nothing: to suit the first picture
  bool side_by_side = false;          // original | level | level with wireframe | error colours where asked for
  bool color_bar = true;              // what the error colours mean, at the right
  bool ground = true;                 // a shadow below the subject
  Rgba8 background = kWhite;
};

// The space that the frames take up: the camera of all of them depends on it.
struct PictureBounds {
  Box box;
  double lowest = std::numeric_limits<double>::infinity();  // along the up axis

  void add(const Surface& surface, UpAxis up);
};

class Photographer {
 public:
  // Precondition: width and height are at least 1.
  Photographer(const PictureOptions& options, const PictureBounds& bounds);

  // The same from another place than options.view says, without a ground.
  Photographer(const PictureOptions& options, const Camera& camera);

  // One picture, or a sheet of them. `original` may be missing where neither error colours nor side by side are asked
  // for. Preconditions: a surface with error colours, and its original, have a triangle.
  Image take(const Surface& level, const std::optional<Surface>& original);

  // What the colours end at; nothing before the first picture with error colours.
  std::optional<double> error_range() const { return options_.error_range; }

 private:
  Image shaded(const Surface& surface, bool wireframe) const;
  Image colored(const Surface& level, const Surface& original);
  RenderOptions render_options() const;
  double wire_width() const;

  PictureOptions options_;
  Camera camera_;
  std::optional<double> ground_height_;
  ClosestPointTree original_tree_;
};

}  // namespace limber::eval
