// SPDX-License-Identifier: Apache-2.0
// The studio: one material under a soft key light, a fill light and a sky, all fixed to the camera and its up
// direction.
#pragma once

#include <vector>

#include "eval/camera.h"
#include "eval/occlusion.h"

namespace limber::eval {

struct Studio {
  Vec3f key, fill, up;                   // unit, from the surface to the light
  std::vector<DirectionalLight> lights;  // the sky and the key as many small lights, for their shadows
};

Studio make_studio(const CameraAxes& axes, const Vec3d& world_up);

// What is lit at one place. All vectors are unit.
struct Surfel {
  Vec3f normal;  // on the side that is seen
  Vec3f to_eye;
  Vec3f albedo;  // linear
  Reached reached;
  bool data = false;  // the colour is a number to be read: no highlight, and shading around 1
};

// Linear light towards the eye, in [0, 1].
Vec3f shade(const Studio& studio, const Surfel& surfel);

// `normal` bent towards the eye as far as needed for the eye to see the side that it belongs to.
Vec3f normal_before_eye(const Vec3f& normal, const Vec3f& to_eye);

// 1 / length times v; `otherwise` where v has no direction.
Vec3f unit_or(const Vec3f& v, const Vec3f& otherwise);

}  // namespace limber::eval
