// SPDX-License-Identifier: Apache-2.0
// A sample clip behind its reader: a mesh, and where its vertices are at any time.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "limber/base/mesh.h"
#include "limber/base/vec.h"

namespace limber {

class SampleMotion {
 public:
  virtual ~SampleMotion() = default;
  virtual const Mesh& mesh() const = 0;
  // Fills positions ([mesh().vertex_count]) for `frame` of `frame_count`.
  virtual void pose(std::uint32_t frame, std::uint32_t frame_count, std::span<Vec3f> positions) const = 0;
};

std::unique_ptr<SampleMotion> make_collapse(Index vertex_count);
std::unique_ptr<SampleMotion> make_gallop(Index vertex_count);
std::unique_ptr<SampleMotion> make_morph(Index vertex_count);
std::unique_ptr<SampleMotion> make_flag(Index vertex_count);

}  // namespace limber
