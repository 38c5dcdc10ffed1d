// SPDX-License-Identifier: Apache-2.0
// How much light reaches the surface that is seen in the picture.
#pragma once

#include <span>
#include <vector>

#include "eval/fragment.h"

namespace limber::eval {

// Light changes slowly over a surface: one place in each cell of 2 x 2 pixels is measured, and looked up by the
// fragments in and around it.
class LightBuffer {
 public:
  explicit LightBuffer(const Scene& scene);

  // The places to be measured.
  const std::vector<Receiver>& receivers() const { return receivers_; }

  // reached: [receivers()]. Before this call all places are fully lit.
  void set_reached(std::span<const Reached> reached);

  // The light that reaches a fragment seen in pixel (x, y): the mean over its cell and the neighbours, those of the
  // same depth and direction first.
  Reached at(int x, int y, const Fragment& fragment) const;

 private:
  struct Entry {
    float inverse_depth = 0.0f;  // 0: nothing seen
    Vec3f normal{};
    Reached reached{};
  };
  int columns_ = 0, rows_ = 0;
  float extent_ = 1.0f;
  std::vector<Entry> entries_;  // [columns * rows]
  std::vector<Receiver> receivers_;
  std::vector<std::size_t> entry_of_;  // [receivers]
};

}  // namespace limber::eval
