// SPDX-License-Identifier: Apache-2.0
// A picture in memory.
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace limber::eval {

// sRGB, straight (not premultiplied) alpha, 0 is transparent.
struct Rgba8 {
  std::uint8_t r = 0, g = 0, b = 0, a = 255;

  friend bool operator==(const Rgba8&, const Rgba8&) = default;
};

inline constexpr Rgba8 kWhite{255, 255, 255, 255};
inline constexpr Rgba8 kTransparent{255, 255, 255, 0};
inline constexpr Rgba8 kInk{38, 40, 46, 255};

// Rows from top to bottom, without padding: pixels[y * width + x].
struct Image {
  int width = 0;
  int height = 0;
  std::vector<Rgba8> pixels;

  Image() = default;

  // Precondition: both sizes are at least 0.
  Image(int w, int h, Rgba8 fill)
      : width(w), height(h), pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), fill) {}

  // Precondition: 0 <= x < width and 0 <= y < height.
  Rgba8& at(int x, int y) { return pixels[offset(x, y)]; }
  const Rgba8& at(int x, int y) const { return pixels[offset(x, y)]; }

  friend bool operator==(const Image&, const Image&) = default;

 private:
  std::size_t offset(int x, int y) const {
    assert(x >= 0 && x < width && y >= 0 && y < height);
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
};

}  // namespace limber::eval
