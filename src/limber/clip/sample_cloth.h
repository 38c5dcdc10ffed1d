// SPDX-License-Identifier: Apache-2.0
// A closed sheet of rubber that falls onto the floor, by extended position based dynamics.
#pragma once

#include <vector>

#include "limber/clip/sample_surface.h"

namespace limber {

struct ClothOptions {
  int key_count = 97;  // states kept, the first of them at rest
  int steps_per_key = 9;
  double duration = 1.9;  // seconds
  double floor = -0.025;  // height, as everything in metres
  Vec3d gravity{0.6, -6.5, 0.3};
};

// The sheet's states, evenly spaced in time: [key_count][vertex_count].
std::vector<std::vector<Vec3f>> drop_cloth(const SurfaceMesh& sheet, const ClothOptions& options);

}  // namespace limber
