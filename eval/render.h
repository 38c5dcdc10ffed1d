// SPDX-License-Identifier: Apache-2.0
// Pictures of triangle meshes, made in software: for the README, for papers, for the report, and for looking at
// results. The same subject, camera and options give the same picture for every number of threads.
#pragma once

#include <optional>
#include <span>

#include "eval/camera.h"
#include "eval/color_map.h"
#include "eval/image.h"
#include "limber/base/mesh.h"
#include "limber/base/vec.h"

namespace limber::eval {

// What a picture is taken of. Refers, does not own. Every corner is less than positions.size(). Triangles with a
// position that is not finite are left out; so are those without area.
struct Subject {
  std::span<const Triangle> triangles;
  std::span<const Vec3f> positions;
  std::span<const Vec3f> normals = {};  // [positions]; empty: computed where smooth shading needs them
  std::span<const Rgba8> colors = {};   // [positions]; empty: the material; alpha is not looked at
  std::span<const float> values = {};   // [positions]; shown through the colour map, before colors; NaN: the material
};

enum class Shading { kSmooth, kFlat };

struct RenderOptions {
  int width = 1200;
  int height = 900;
  int sample_count = 16;  // per pixel: 1, 4, 8 or 16
  Shading shading = Shading::kSmooth;

  double wire_width = 0.0;     // pixels; 0: no wireframe
  double outline_width = 0.0;  // pixels, around silhouettes and borders; at least the wire's with a wireframe; 0: none
  Rgba8 ink{34, 37, 46, 255};  // of wire and outline; alpha is the strength

  Rgba8 material{192, 186, 177, 255};
  Rgba8 back_material{152, 170, 200, 255};  // of triangles seen from behind
  Rgba8 background = kWhite;                // alpha 0: transparent

  ColorMap color_map = ColorMap::kHeat;
  float low_value = 0.0f;  // at the low end of the map
  float high_value = 1.0f;

  bool occlusion = true;  // soft shadows of the mesh on itself
  // Height of the ground along the camera's up, on which the mesh casts a shadow; nothing: no ground. One height for
  // all frames of a clip keeps the shadow still.
  std::optional<double> ground_height = {};
};

// Precondition: width and height are at least 1; normals, colors and values are empty or [positions].
Image render(const Subject& subject, const Camera& camera, const RenderOptions& options);

// The box around the triangles whose positions are finite.
Box bounding_box(std::span<const Triangle> triangles, std::span<const Vec3f> positions);

// The least dot(position, up) over the corners of the same triangles, `up` brought to unit length; 0 where there are
// none.
double lowest_height(std::span<const Triangle> triangles, std::span<const Vec3f> positions, const Vec3d& up);

}  // namespace limber::eval
