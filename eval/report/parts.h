// SPDX-License-Identifier: Apache-2.0
// What methods make of named parts of a surface: how many triangles they spend on an ear, and how near they come to it.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "eval/closest_point.h"
#include "eval/sample_surface.h"
#include "eval/surface.h"
#include "limber/base/result.h"

namespace limber::eval {

// The part is what of the first frame lies in a ball; the same triangles are it in every frame.
struct PartBall {
  std::string name{};
  Vec3d center{};  // as the clip's own positions
  double radius = 0;
};

// Of one method.
struct PartMeasure {
  double triangles = 0;  // mean over the frames; a triangle belongs to the part whose surface is nearest its middle
  double last_triangles = 0;  // of the last frame alone
  double rms = 0;             // mean over the frames: distance from the part, percent of the diagonal of the frame
};

class Parts {
 public:
  // Precondition: method_count > 0.
  Parts(std::vector<PartBall> balls, std::size_t method_count, std::uint64_t seed);

  // The next frame. Error kBadInput: no triangle has its middle in one of the balls. Preconditions: as of
  // WorstPlaces::add().
  Result<void> add(const Surface& original, std::span<const Surface> approximations);

  std::size_t size() const { return balls_.size(); }
  const PartBall& ball(std::size_t part) const { return balls_[part]; }
  std::span<const Index> triangles(std::size_t part) const { return triangles_[part]; }  // of the original; rising

  // Precondition: a frame has been added.
  PartMeasure measure(std::size_t part, std::size_t method) const;

 private:
  Result<void> find(const Surface& original);
  void count_triangles(const Surface& approximation, std::size_t method);

  std::vector<PartBall> balls_;
  std::uint64_t seed_;
  std::size_t frame_count_ = 0;
  std::vector<std::vector<Index>> triangles_;        // [parts]
  std::vector<std::vector<SurfaceSample>> samples_;  // [parts], on the original
  std::vector<std::vector<PartMeasure>> sums_;       // [parts][methods], of all frames but for the last's count
  ClosestPointTree original_tree_, approximation_tree_;
  std::vector<Vec3d> points_;          // scratch
  std::vector<ClosestPoint> closest_;  // scratch
};

}  // namespace limber::eval
