// SPDX-License-Identifier: Apache-2.0
// What a triangle looks like at one place of the picture, before light.
#pragma once

#include <span>
#include <vector>

#include "eval/raster.h"
#include "eval/render.h"
#include "eval/shade.h"

namespace limber::eval {

// All that is the same for a whole picture.
struct Scene {
  const Subject& subject;
  const RenderOptions& options;
  Projection projection;
  double near = 0.0;
  double extent = 0.0;                // of the subject, to compare depths with
  std::vector<ScreenPoint> points{};  // [positions]
  std::vector<Vec3f> own_normals{};   // computed where the subject brings none
  std::span<const Vec3f> normals{};   // [positions]; empty for flat shading
  std::vector<PixelBox> boxes{};      // [triangles]
  TileBins bins{};                    // of the triangles
};

Scene make_scene(const Subject& subject, const Camera& camera, const RenderOptions& options);

struct Fragment {
  Vec3f position;
  Vec3f facing;  // unit normal of the flat triangle on the side that is seen
  Vec3f normal;  // unit, of the shading, on that side and bent so that the eye sees it
  Vec3f to_eye;  // unit
  float inverse_depth = 0.0f;
  double weights[3] = {};  // barycentric
  bool front = true;
};

// Triangle `t`, which is seen at (x, y) or so near to it that the same plane may be used.
Fragment fragment_at(const Scene& scene, Index t, double x, double y);

// Linear colour of the material, and whether it stands for a number.
struct Albedo {
  Vec3f color;
  bool data = false;
};

Albedo albedo_of(const Scene& scene, Index t, const Fragment& fragment);

}  // namespace limber::eval
