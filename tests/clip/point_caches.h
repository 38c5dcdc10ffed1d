// SPDX-License-Identifier: Apache-2.0
// Point caches made by hand, independently of the writers.
#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include "limber/clip/byte_order.h"

namespace limber::test {

template <std::endian kOrder>
std::string bytes_of(std::uint32_t value) {
  char bytes[4];
  store<std::uint32_t, kOrder>(value, bytes);
  return {bytes, 4};
}

template <std::endian kOrder>
std::string bytes_of(float value) {
  return bytes_of<kOrder>(std::bit_cast<std::uint32_t>(value));
}

inline std::string pc2_header(std::uint32_t points, std::uint32_t frames, std::uint32_t version = 1, float start = 0,
                              float step = 1) {
  constexpr std::endian kOrder = std::endian::little;
  return std::string("POINTCACHE2\0", 12) + bytes_of<kOrder>(version) + bytes_of<kOrder>(points) +
         bytes_of<kOrder>(start) + bytes_of<kOrder>(step) + bytes_of<kOrder>(frames);
}

inline std::string mdd_header(std::uint32_t points, const std::vector<float>& times) {
  constexpr std::endian kOrder = std::endian::big;
  std::string header = bytes_of<kOrder>(static_cast<std::uint32_t>(times.size())) + bytes_of<kOrder>(points);
  for (const float time : times) header += bytes_of<kOrder>(time);
  return header;
}

// Four points that all lie at (frame, 0, -1), per frame.
template <std::endian kOrder>
std::string four_points(std::uint32_t frames) {
  std::string bytes;
  for (std::uint32_t frame = 0; frame < frames; ++frame) {
    for (int point = 0; point < 4; ++point) {
      bytes += bytes_of<kOrder>(static_cast<float>(frame)) + bytes_of<kOrder>(0.0f) + bytes_of<kOrder>(-1.0f);
    }
  }
  return bytes;
}

}  // namespace limber::test
