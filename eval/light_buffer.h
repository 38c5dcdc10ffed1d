// SPDX-License-Identifier: Apache-2.0
// How much light reaches the surface that is seen in each pixel.
#pragma once

#include <vector>

#include "eval/fragment.h"

namespace limber::eval {

// One measurement at the centre of each pixel, looked up by the fragments in and around it.
class LightBuffer {
 public:
  LightBuffer(const Scene& scene, const Studio& studio);

  // The light that reaches a fragment seen in pixel (x, y): the mean over the pixel and its neighbours, those of the
  // same depth and direction first.
  Reached at(int x, int y, const Fragment& fragment) const;

 private:
  struct Entry {
    float inverse_depth = 0.0f;  // 0: nothing seen
    Vec3f normal;
    Reached reached;
  };
  int width_ = 0, height_ = 0;
  float extent_ = 1.0f;
  std::vector<Entry> entries_;  // [width * height]
};

}  // namespace limber::eval
