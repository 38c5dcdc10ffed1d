// SPDX-License-Identifier: Apache-2.0
// A short clip for tests of methods that follow one.
#pragma once

#include <gtest/gtest.h>
#include <string_view>
#include <vector>

#include "eval/changed.h"
#include "eval/methods/method.h"
#include "limber/clip/clip.h"

namespace limber::eval {

class Gallop : public testing::Test {
 protected:
  // Made once: a sample takes longer than what is done with it.
  static void SetUpTestSuite() {
    const auto reader = open_clip("sample:gallop?vertices=1500&frames=8", {});
    mesh_ = (*reader)->mesh();
    std::vector<Vec3f> positions(mesh_.vertex_count);
    frames_.clear();
    while (*(*reader)->read(positions)) frames_.push_back(positions);
    seen_.assign(frames_.begin(), frames_.end());
  }

  // What a method that has seen `seen` makes of the frames.
  static std::vector<Approximation> run(std::string_view name, const MethodOptions& options,
                                        std::span<const std::span<const Vec3f>> seen,
                                        const std::vector<std::vector<Vec3f>>& frames) {
    const auto method = find_method(name)->create(options);
    method->begin(mesh_, seen);
    std::vector<Approximation> all(frames.size());
    for (std::size_t t = 0; t < all.size(); ++t) method->frame(frames[t], all[t]);
    return all;
  }

  static double mean_changed(const std::vector<Approximation>& all) {
    ChangedTriangles changed;
    double sum = 0;
    std::vector<Triangle> ids;
    for (const Approximation& made : all) {
      name_corners(made, ids);
      sum += changed.add(ids).value_or(0);
    }
    return sum / static_cast<double>(all.size() - 1);
  }

  inline static Mesh mesh_;
  inline static std::vector<std::vector<Vec3f>> frames_;
  inline static std::vector<std::span<const Vec3f>> seen_;  // all of them
};

}  // namespace limber::eval
