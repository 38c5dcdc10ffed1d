// SPDX-License-Identifier: Apache-2.0
// What a level of detail is looked at with: where its errors matter, and by how much. What all criteria of a view have
// in common is the `allowance` that they make: how many times larger an error may be at some place than where it
// matters most (Hoppe, "View-dependent refinement of progressive meshes", 1997; Luebke and Erikson 1997). Part of the
// player: standard library only.
#pragma once

#include <optional>

#include "limber/base/mesh.h"
#include "limber/base/vec.h"
#include "limber/view/camera.h"

namespace limber {

// Finer in a ball. The allowance is 1 inside and grows to `outside` over one radius beyond.
struct Focus {
  Vec3d center;
  double radius = 1;   // in the units of the input, > 0
  float outside = 32;  // >= 1
};

// Finer towards one end of an axis (Kircher & Garland 2005, Fig. 12). The allowance is 1 at and before `from` and grows
// evenly to `coarsest` at and beyond `to`, which may be less than `from`.
struct Along {
  int axis = 0;  // 0, 1, 2: x, y, z
  double from = 0, to = 1;
  float coarsest = 64;  // >= 1
};

// Criteria combine: their allowances are multiplied.
//
// With a camera errors are in pixels: a distance d at depth z counts for d / z times the pixels of a length of 1 at
// depth 1, as much as if it lay across the line of sight. Outside the picture half of the distance to what is seen is
// allowed on top (where the limit is N pixels; where there is none, N = 1), so that what is coarse there does not reach
// into it. Without a camera errors are in percent of the diagonal of the frame's bounding box.
struct View {
  std::optional<Camera> camera;
  Index width = 1200, height = 900;  // of the picture, in pixels, >= 1
  float silhouettes = 1;             // >= 1: how many times smaller an error must be on the silhouette
  float facing_away = 1;             // >= 1: how many times larger it may be where the surface faces away
  std::optional<Focus> focus;
  std::optional<Along> along;
};

}  // namespace limber
