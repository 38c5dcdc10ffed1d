// SPDX-License-Identifier: Apache-2.0
#include "eval/picture.h"

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cmath>
#include <fmt/format.h>

#include "eval/normals.h"
#include "eval/sheet.h"
#include "eval/subdivide.h"
#include "limber/base/portable_math.h"

namespace limber::eval {
namespace {

struct NamedView {
  std::string_view name;
  View view;
};

constexpr NamedView kViews[] = {
    {"front", {0, 6}}, {"back", {180, 6}}, {"left", {-90, 6}},          {"right", {90, 6}},
    {"side", {90, 6}}, {"top", {0, 90}},   {"three-quarter", {40, 14}},
};

std::optional<double> parse_number(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

Vec3d up_vector(UpAxis up) { return up == UpAxis::kY ? Vec3d{0, 1, 0} : Vec3d{0, 0, 1}; }

// The next of 1, 2, 3, 4, 6, 8, 10, 20, ... at or above the value that 98 of 100 do not exceed.
double range_for(std::vector<float> values) {
  const auto rank = static_cast<std::ptrdiff_t>(values.size() * 98 / 100);
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  const double wanted = values[static_cast<std::size_t>(rank)];
  double decade = 1e-4;
  while (decade * 10 < wanted) decade *= 10;
  for (const double step : {1.0, 2.0, 3.0, 4.0, 6.0, 8.0}) {
    if (decade * step >= wanted) return decade * step;
  }
  return decade * 10;
}

std::string thousands(std::size_t count) {
  std::string digits = fmt::format("{}", count);
  for (std::size_t at = digits.size(); at > 3;) digits.insert(at -= 3, 1, ',');
  return digits;
}

std::string size_label(const Surface& surface) {
  return fmt::format("{} vertices, {} triangles", thousands(used_vertex_count(surface)),
                     thousands(surface.triangles.size()));
}

}  // namespace

std::optional<View> parse_view(std::string_view text) {
  for (const NamedView& named : kViews) {
    if (named.name == text) return named.view;
  }
  const std::size_t comma = text.find(',');
  if (comma == std::string_view::npos) return std::nullopt;
  const auto azimuth = parse_number(text.substr(0, comma)), elevation = parse_number(text.substr(comma + 1));
  if (!azimuth || !elevation || std::abs(*azimuth) > 360 || std::abs(*elevation) > 90) return std::nullopt;
  return View{*azimuth, *elevation};
}

std::optional<Rgba8> parse_color(std::string_view text) {
  if (text == "white") return kWhite;
  if (text == "black") return Rgba8{0, 0, 0, 255};
  if (text == "transparent") return kTransparent;
  std::uint32_t value = 0;
  if (text.size() != 7 || text[0] != '#') return std::nullopt;
  const auto [end, error] = std::from_chars(text.data() + 1, text.data() + 7, value, 16);
  if (error != std::errc{} || end != text.data() + 7) return std::nullopt;
  return Rgba8{static_cast<std::uint8_t>(value >> 16), static_cast<std::uint8_t>(value >> 8 & 255),
               static_cast<std::uint8_t>(value & 255), 255};
}

Vec3d direction_to_eye(const View& view, UpAxis up) {
  const double azimuth = view.azimuth * kPi / 180, elevation = view.elevation * kPi / 180;
  const double forward = portable_cos(azimuth) * portable_cos(elevation);
  const double sideways = portable_sin(azimuth) * portable_cos(elevation);
  const double upward = portable_sin(elevation);
  return up == UpAxis::kY ? Vec3d{sideways, upward, forward} : Vec3d{sideways, -forward, upward};
}

void PictureBounds::add(const Surface& surface, UpAxis up) {
  const Box frame = bounding_box(surface.triangles, surface.positions);
  if (frame.empty()) return;
  box.add(frame.low);
  box.add(frame.high);
  lowest = std::min(lowest, dot(frame.low, up_vector(up)));
}

Photographer::Photographer(const PictureOptions& options, const PictureBounds& bounds) : options_(options) {
  assert(options.width >= 1 && options.height >= 1);
  // The bar that explains the colours stands at the right.
  const double margin = options.error_colors && options.color_bar ? 0.13 : 0.06;
  camera_ = frame_camera(bounds.box, direction_to_eye(options.view, options.up),
                         static_cast<double>(options.width) / options.height,
                         {.up = up_vector(options.up), .margin = margin});
  if (options.ground && std::isfinite(bounds.lowest)) ground_height_ = bounds.lowest;
}

Photographer::Photographer(const PictureOptions& options, const Camera& camera) : options_(options), camera_(camera) {
  assert(options.width >= 1 && options.height >= 1);
}

double Photographer::wire_width() const {
  return options_.wire_width > 0 ? options_.wire_width
                                 : std::max(0.7, 0.0011 * std::min(options_.width, options_.height));
}

RenderOptions Photographer::render_options() const {
  RenderOptions render;
  render.width = options_.width;
  render.height = options_.height;
  render.shading = options_.shading;
  render.background = options_.background;
  render.ground_height = ground_height_;
  return render;
}

Image Photographer::shaded(const Surface& surface, bool wireframe) const {
  RenderOptions render = render_options();
  if (wireframe) render.wire_width = wire_width();
  return eval::render({.triangles = surface.triangles, .positions = surface.positions}, camera_, render);
}

// An approximation touches its original at its vertices, more or less: the distance is shown inside its triangles too.
Image Photographer::colored(const Surface& level, const Surface& original) {
  // In a small picture fewer say as much.
  const double wanted_triangles = std::clamp(options_.width * options_.height / 9.0, 30'000.0, 120'000.0);
  const auto triangle_count = static_cast<double>(level.triangles.size());
  const double steps = std::clamp(std::ceil(std::sqrt(wanted_triangles / triangle_count)), 1.0, 24.0);
  const Subdivided fine = subdivide(level, vertex_normals(level.triangles, level.positions), static_cast<Index>(steps));

  original_tree_.rebuild(original);
  std::vector<Vec3d> points(fine.positions.size());
  std::transform(fine.positions.begin(), fine.positions.end(), points.begin(), [](const Vec3f& p) { return Vec3d(p); });
  std::vector<ClosestPoint> closest(points.size());
  original_tree_.closest(points, closest);
  const double diagonal = eval::bounding_box(original).diagonal();
  std::vector<float> values(points.size());
  std::transform(closest.begin(), closest.end(), values.begin(), [&](const ClosestPoint& c) {
    return static_cast<float>(diagonal > 0 ? 100 * std::sqrt(c.squared_distance) / diagonal : 0.0);
  });
  if (!options_.error_range) options_.error_range = range_for(values);

  RenderOptions render = render_options();
  render.low_value = 0;
  render.high_value = static_cast<float>(*options_.error_range);
  // Edges of the level are borders of what it was cut into: strokes along borders are its wireframe.
  if (options_.wireframe) render.outline_width = wire_width();
  Image image = eval::render(
      {.triangles = fine.triangles, .positions = fine.positions, .normals = fine.normals, .values = values}, camera_,
      render);
  if (!options_.color_bar) return image;
  const bool dark = options_.background.a > 0 && options_.background.g < 96;
  draw_color_bar(image, {.high = static_cast<float>(*options_.error_range), .title = "distance, % of diagonal"},
                 dark ? kWhite : kInk);
  return image;
}

Image Photographer::take(const Surface& level, const std::optional<Surface>& original) {
  assert(original || !(options_.error_colors || options_.side_by_side));
  if (!options_.side_by_side) {
    return options_.error_colors ? colored(level, *original) : shaded(level, options_.wireframe);
  }
  std::vector<SheetTile> tiles;
  tiles.push_back({shaded(*original, false), fmt::format("original: {}", size_label(*original))});
  tiles.push_back({shaded(level, false), size_label(level)});
  tiles.push_back({shaded(level, true), "its triangles"});
  if (options_.error_colors) tiles.push_back({colored(level, *original), "its distance to the original"});
  const bool dark = options_.background.a > 0 && options_.background.g < 96;
  return contact_sheet(tiles, {.background = options_.background, .ink = dark ? kWhite : kInk});
}

}  // namespace limber::eval
