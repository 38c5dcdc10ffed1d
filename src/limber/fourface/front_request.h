// SPDX-License-Identifier: Apache-2.0
// What a front is asked to be: how fine, where, and seen from where.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "limber/base/vec.h"
#include "limber/fourface/criteria.h"
#include "limber/fourface/four_k_mesh.h"
#include "limber/fourface/front.h"

namespace limber {

// A perspective picture. Precondition: the target is not the eye; 0 < fov_degrees < 180; sizes > 0.
struct Viewpoint {
  Vec3d eye, target;
  Vec3d up{0, 1, 0};                  // stands upright in the picture, unless it is parallel to the view
  double fov_degrees = 50;            // vertical
  double width = 1280, height = 720;  // pixels
};

// What is seen: in front of the eye, and between the four sides of the picture.
std::array<HalfSpace, 5> seen_from(const Viewpoint& view);

// How many pixels high something is in the middle of the picture, as many times as it is smaller than its distance.
double pixels_per_slope(const Viewpoint& view);

struct Ball {
  Vec3d center;
  double radius = 0;
};

// At most one of the first three. With one of them, as fine as it allows, by the errors as they are seen from the
// viewpoint, if there is one. Else as coarse as all the limits allow that are given; where none is, the finest.
struct FrontRequest {
  std::optional<Index> vertices, triangles;
  std::optional<Index> level;     // of FourKMesh::level_begin
  std::optional<double> error;    // distance, >= 0
  std::optional<double> pixels;   // the error as it is seen; needs a viewpoint
  std::optional<double> bend;     // as of bends(), 0 to 2
  std::optional<Viewpoint> view;  // what it does not see is as coarse as can be ...
  std::optional<Ball> focus;      // ... and so is what lies outside the ball
};

// [operation_count]: 1 less the least cosine between the normals of triangles that an operation, or one that it depends
// on, destroys and creates: how much the surface is bent there. Monotone. positions: [mesh.vertex_count].
std::vector<float> bends(const FourKMesh& mesh, std::span<const Vec3f> positions);

// [operation_count]: 1 where an operation is applied in the front that the request, which has none of its first three,
// asks for. positions, bend: as for move_front().
std::vector<std::uint8_t> applied_operations(const FourKMesh& mesh, std::span<const Vec3f> positions,
                                             const FrontRequest& request, std::span<const float> bend = {});

// Moves the front to what is asked for. positions: of the frame for which the mesh has its errors and radii. hysteresis
// >= 1: operations that are applied count so many times less, so that little changes where many are alike; 1: the front
// depends on the request alone. bend: bends(), where the request has one; else anything.
void move_front(Front& front, const FourKMesh& mesh, std::span<const Vec3f> positions, const FrontRequest& request,
                std::span<const float> bend = {}, double hysteresis = 1);

}  // namespace limber
