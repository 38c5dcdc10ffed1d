// SPDX-License-Identifier: Apache-2.0
// Two passes. The first finds what the centre of each pixel shows and how much light reaches it (light_buffer.h). The
// second goes through tiles: visibility at all samples, strokes over them, one shading for each triangle seen in a
// pixel, the mean of the samples in linear light. Nothing larger than a tile is kept at sample resolution.
#include "eval/render.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>

#include "eval/finite.h"
#include "eval/fragment.h"
#include "eval/ground.h"
#include "eval/light_buffer.h"
#include "eval/parallel_for.h"
#include "eval/shade.h"
#include "eval/srgb.h"
#include "eval/strokes.h"

namespace limber::eval {
namespace {

struct Outline {
  double width = 0.0;
  std::vector<Segment> segments;
  TileBins bins;
};

Outline make_outline(const Scene& scene) {
  Outline outline;
  const RenderOptions& options = scene.options;
  outline.width = std::max(options.outline_width, options.wire_width);
  if (!(outline.width > 0.0)) return outline;
  outline.segments = silhouette_edges(scene.subject.triangles, scene.points);
  std::vector<PixelBox> boxes;
  boxes.reserve(outline.segments.size());
  for (const Segment& s : outline.segments) {
    const ScreenPoint ends[2] = {scene.points[s[0]], scene.points[s[1]]};
    boxes.push_back(pixel_box(ends, options.width, options.height, 0.5 * outline.width + 1.0));
  }
  outline.bins = bin_boxes(boxes, options.width, options.height);
  return outline;
}

// The three lines that a triangle draws on itself.
struct WireLines {
  EdgeFunctions edges;
  double scale[3] = {};  // edge function to pixels
  float strength[3] = {};
};

// Where triangles are hardly wider than the line, lines would run together to a dark surface: they fade instead.
WireLines wire_lines(const Scene& scene, Index t) {
  const Triangle& corner = scene.subject.triangles[t];
  const ScreenPoint* p[3] = {&scene.points[corner[0]], &scene.points[corner[1]], &scene.points[corner[2]]};
  WireLines lines{.edges = edge_functions(*p[0], *p[1], *p[2])};
  for (int k = 0; k < 3; ++k) {
    const double slope = std::sqrt(lines.edges.a[k] * lines.edges.a[k] + lines.edges.b[k] * lines.edges.b[k]);
    if (!(slope > 0.0)) continue;
    lines.scale[k] = 1.0 / slope;
    const double height = p[k]->w > 0.0 ? lines.edges.det / (p[k]->w * slope) : 1e9;
    lines.strength[k] = static_cast<float>(std::clamp(height / (4.5 * scene.options.wire_width), 0.10, 1.0));
  }
  return lines;
}

float wire_ink(const WireLines& lines, double x, double y, double width) {
  float ink = 0.0f;
  for (int k = 0; k < 3; ++k) {
    if (lines.scale[k] <= 0.0) continue;
    ink = std::max(ink, lines.strength[k] * ink_share(std::max(0.0, lines.edges.at(k, x, y) * lines.scale[k]), width));
  }
  return ink;
}

// All that the second pass reads.
struct Picture {
  Scene scene;
  Studio studio{};
  Outline outline{};
  std::optional<LightBuffer> light{};
  std::optional<GroundShadow> ground{};
  Vec3f ink{}, background{};  // linear
  float ink_strength = 1.0f, background_alpha = 1.0f;
};

Vec3f lit_color(const Picture& picture, Index t, int x, int y, double place_x, double place_y) {
  const Fragment fragment = fragment_at(picture.scene, t, place_x, place_y);
  const Albedo albedo = albedo_of(picture.scene, t, fragment);
  Surfel surfel{fragment.normal, fragment.to_eye, albedo.color, {}, albedo.data};
  if (picture.light) surfel.reached = picture.light->at(x, y, fragment);
  return shade(picture.studio, surfel);
}

struct Premultiplied {
  Vec3f light;
  float alpha = 0.0f;
};

// A shadow that the frame of the picture cut off would show the frame on a white page.
float fade_to_frame(const RenderOptions& options, int x, int y) {
  const float width = 0.22f * static_cast<float>(std::min(options.width, options.height));
  const auto fade = [width](int place, int size) {
    const float t = std::min(1.0f, static_cast<float>(std::min(place, size - 1 - place)) / width);
    return t * t * (3.0f - 2.0f * t);
  };
  return fade(x, options.width) * fade(y, options.height);
}

Premultiplied background_at(const Picture& picture, int x, int y) {
  Premultiplied result{picture.background * picture.background_alpha, picture.background_alpha};
  if (picture.ground) {
    const Projection& projection = picture.scene.projection;
    const float dark = picture.ground->darkness(projection.eye(), projection.ray(x + 0.5, y + 0.5)) *
                       fade_to_frame(picture.scene.options, x, y);
    constexpr Vec3f kShadow{0.020f, 0.022f, 0.030f};
    result.light = result.light * (1.0f - dark) + kShadow * dark;
    result.alpha = result.alpha * (1.0f - dark) + dark;
  }
  return result;
}

Rgba8 resolve_pixel(const Picture& picture, const SamplePattern& pattern, const TileSamples& tile,
                    std::span<const float> strokes, int x, int y) {
  const std::size_t first = tile.offset(x, y);
  const double wire_width = picture.scene.options.wire_width;
  Premultiplied sum;
  std::uint32_t left = (1u << pattern.count) - 1u;
  while (left != 0) {
    // One shading for all samples of the pixel that show the same triangle, in the middle of them, which is inside it.
    int s = 0;
    while (((left >> s) & 1u) == 0) ++s;
    const Index t = tile.triangle[first + static_cast<std::size_t>(s)];
    std::uint32_t same = 0;
    double middle_x = 0.0, middle_y = 0.0, count = 0.0;
    for (int k = s; k < pattern.count; ++k) {
      if (((left >> k) & 1u) == 0 || tile.triangle[first + static_cast<std::size_t>(k)] != t) continue;
      same |= 1u << k;
      middle_x += pattern.x[k], middle_y += pattern.y[k], count += 1.0;
    }
    left &= ~same;

    Premultiplied shown;
    std::optional<WireLines> lines;
    if (t == kNone) {
      shown = background_at(picture, x, y);
    } else {
      shown = {lit_color(picture, t, x, y, x + middle_x / count, y + middle_y / count), 1.0f};
      if (wire_width > 0.0) lines = wire_lines(picture.scene, t);
    }
    for (int k = s; k < pattern.count; ++k) {
      if (((same >> k) & 1u) == 0) continue;
      float ink = strokes.empty() ? 0.0f : strokes[first + static_cast<std::size_t>(k)];
      if (lines) ink = std::max(ink, wire_ink(*lines, x + pattern.x[k], y + pattern.y[k], wire_width));
      ink *= picture.ink_strength;
      sum.light += shown.light * (1.0f - ink) + picture.ink * ink;
      sum.alpha += shown.alpha * (1.0f - ink) + ink;
    }
  }
  const float scale = 1.0f / static_cast<float>(pattern.count);
  return pixel_from_premultiplied(sum.light * scale, sum.alpha * scale);
}

// Light for the surface and the ground at once: both need the same depth maps.
void light_up(Picture& picture) {
  std::vector<Receiver> receivers;
  if (picture.light) receivers = picture.light->receivers();
  const std::size_t seen_count = receivers.size();
  if (picture.ground) {
    const std::vector<Receiver> below = picture.ground->receivers();
    receivers.insert(receivers.end(), below.begin(), below.end());
  }
  if (receivers.empty()) return;
  const std::vector<Reached> reached =
      reached_light(picture.scene.subject.triangles, picture.scene.subject.positions, picture.studio.lights, receivers);
  if (picture.light) picture.light->set_reached(std::span(reached).first(seen_count));
  if (picture.ground) picture.ground->set_reached(std::span(reached).subspan(seen_count));
}

struct TileScratch {
  TileSamples samples;
  std::vector<float> strokes;
};

void render_tile(const Picture& picture, const SamplePattern& pattern, std::size_t index, TileScratch& scratch,
                 Image& image) {
  const Scene& scene = picture.scene;
  clear_tile(scene.bins, index, image.width, image.height, pattern.count, scratch.samples);
  draw_tile(scene.subject.triangles, scene.points, items_of(scene.bins, index), pattern, scene.near, scratch.samples);
  scratch.strokes.clear();
  if (const std::span<const Index> items = items_of(picture.outline.bins, index); !items.empty()) {
    scratch.strokes.assign(scratch.samples.triangle.size(), 0.0f);
    draw_strokes(picture.outline.segments, scene.points, items, pattern, picture.outline.width, scratch.samples,
                 scratch.strokes);
  }
  const PixelBox& pixels = scratch.samples.pixels;
  for (int y = pixels.y0; y < pixels.y1; ++y) {
    for (int x = pixels.x0; x < pixels.x1; ++x) {
      image.at(x, y) = resolve_pixel(picture, pattern, scratch.samples, scratch.strokes, x, y);
    }
  }
}

}  // namespace

Box bounding_box(std::span<const Triangle> triangles, std::span<const Vec3f> positions) {
  Box box;
  for (const Triangle& t : triangles) {
    if (!has_finite_corners(t, positions)) continue;
    for (const Index corner : t) box.add(Vec3d(positions[corner]));
  }
  return box;
}

double lowest_height(std::span<const Triangle> triangles, std::span<const Vec3f> positions, const Vec3d& up) {
  const double l = length(up);
  double lowest = std::numeric_limits<double>::infinity();
  for (const Triangle& t : triangles) {
    if (!has_finite_corners(t, positions)) continue;
    for (const Index corner : t) lowest = std::min(lowest, dot(Vec3d(positions[corner]), up));
  }
  return std::isfinite(lowest) && l > 0.0 ? lowest / l : 0.0;
}

Image render(const Subject& subject, const Camera& camera, const RenderOptions& options) {
  assert(options.width >= 1 && options.height >= 1);
  assert(subject.normals.empty() || subject.normals.size() == subject.positions.size());
  assert(subject.colors.empty() || subject.colors.size() == subject.positions.size());
  assert(subject.values.empty() || subject.values.size() == subject.positions.size());
  Picture picture{.scene = make_scene(subject, camera, options)};
  picture.studio = make_studio(picture.scene.projection.axes(), camera.up);
  picture.outline = make_outline(picture.scene);
  picture.ink = linear_from_srgb(options.ink);
  picture.ink_strength = static_cast<float>(options.ink.a) / 255.0f;
  picture.background = linear_from_srgb(options.background);
  picture.background_alpha = static_cast<float>(options.background.a) / 255.0f;
  if (options.occlusion) picture.light.emplace(picture.scene);
  if (options.ground_height) {
    picture.ground.emplace(subject.triangles, subject.positions, picture.studio.up, *options.ground_height);
  }
  light_up(picture);

  Image image(options.width, options.height, options.background);
  const SamplePattern pattern = sample_pattern(options.sample_count);
  parallel_for_ranges(picture.scene.bins.offsets.size() - 1, 1, [&](std::size_t first, std::size_t end) {
    TileScratch scratch;
    for (std::size_t index = first; index < end; ++index) render_tile(picture, pattern, index, scratch, image);
  });
  return image;
}

}  // namespace limber::eval
