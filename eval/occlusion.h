// SPDX-License-Identifier: Apache-2.0
// How much light from far away reaches points near a mesh: a depth map for each of many directions, averaged. This
// gives ambient occlusion, a soft key shadow and the shadow on the ground without any tree of triangles.
#pragma once

#include <span>
#include <vector>

#include "limber/base/mesh.h"
#include "limber/base/vec.h"

namespace limber::eval {

// Light from a direction, with its share in the sky (weighted by the cosine at the receiver) and in the key light (not
// weighted).
struct DirectionalLight {
  Vec3f towards;  // unit, from the receiver to the light
  float sky = 0.0f;
  float key = 0.0f;
};

// Points that receive light; `facing` is the unit normal of the flat triangle on the side that is seen, `normal` the
// one that is shaded with.
struct Receiver {
  Vec3f point, facing, normal;
};

// Shares in [0, 1] of the light that is not held back by the mesh.
struct Reached {
  float sky = 1.0f;
  float key = 1.0f;
};

// Result: [receivers]. Triangles with positions that are not finite hold nothing back. The same for any thread count.
std::vector<Reached> reached_light(std::span<const Triangle> triangles, std::span<const Vec3f> positions,
                                   std::span<const DirectionalLight> lights, std::span<const Receiver> receivers);

// `count` unit vectors spread evenly over the sphere.
std::vector<Vec3f> sphere_directions(int count);

}  // namespace limber::eval
