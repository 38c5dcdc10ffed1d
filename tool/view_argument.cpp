// SPDX-License-Identifier: Apache-2.0
#include "tool/view_argument.h"

#include "tool/exit.h"
#include "tool/ranges.h"

namespace limber::tool {
namespace {

Vec3d vector_of(const std::vector<double>& numbers) { return {numbers[0], numbers[1], numbers[2]}; }

}  // namespace

void declare_viewpoint(CLI::App& app, ViewArgument& argument) {
  const auto vector = [&](const char* name, std::vector<double>& to, int count, const char* type, const char* what) {
    app.add_option(name, to, what)->delimiter(',')->expected(count)->type_name(type)->check(in_range(-1e30, 1e30));
  };
  vector("--eye", argument.eye, 3, "X,Y,Z", "seen from here: what is not in the picture is as coarse as can be");
  vector("--target", argument.target, 3, "X,Y,Z", "the middle of the picture");
  app.add_option("--fov", argument.fov_degrees, "vertical field of view, in degrees")
      ->check(in_range(1, 170))
      ->type_name("DEG")
      ->capture_default_str();
  app.add_option("--pixels", argument.pixels, "as coarse as an error of so many pixels allows, in a picture of --size")
      ->check(in_range(0, 1e6))
      ->type_name("N");
  vector("--focus", argument.focus, 4, "X,Y,Z,R", "fine in this ball alone");
  app.add_option("--curvature", argument.curvature, "as coarse as bends of so many degrees allow; four-face files only")
      ->check(in_range(0, 180))
      ->type_name("DEG");
}

FrontRequest view_request(const ViewArgument& argument, int width, int height) {
  FrontRequest request;
  if (argument.eye.empty() != argument.target.empty()) throw UsageError("--eye and --target need each other");
  if (argument.pixels && argument.eye.empty()) throw UsageError("--pixels needs --eye and --target");
  if (!argument.eye.empty()) {
    Viewpoint view{.eye = vector_of(argument.eye), .target = vector_of(argument.target)};
    view.fov_degrees = argument.fov_degrees;
    if (view.eye == view.target) throw UsageError("--eye and --target are the same point");
    view.width = width;
    view.height = height;
    request.view = view;
  }
  if (!argument.focus.empty()) {
    if (!(argument.focus[3] >= 0)) throw UsageError("the radius of --focus must not be negative");
    request.focus = Ball{vector_of(argument.focus), argument.focus[3]};
  }
  request.pixels = argument.pixels;
  return request;
}

}  // namespace limber::tool
