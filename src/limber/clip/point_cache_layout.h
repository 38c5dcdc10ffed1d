// SPDX-License-Identifier: Apache-2.0
// Point caches: files of positions only, frame after frame, beside a mesh. The header of each kind, byte by byte:
//
//   PC2, little endian                       MDD, big endian
//    0  "POINTCACHE2" and a zero byte         0  int32  number of frames F
//   12  int32  version, 1                     4  int32  number of points N
//   16  int32  number of points N             8  float  the time of each frame, in seconds, F times
//   20  float  number of the first frame          then x, y, z as floats, N times per frame
//   24  float  frames from sample to sample
//   28  int32  number of frames F
//   32  x, y, z as floats, N times per frame
#pragma once

#include <bit>
#include <cstdint>
#include <filesystem>
#include <optional>

#include "limber/base/result.h"
#include "limber/clip/input_file.h"

namespace limber {

enum class PointCacheFormat { kPc2, kMdd };

// By the extension, in upper or lower case.
std::optional<PointCacheFormat> point_cache_format(const std::filesystem::path& path);

inline constexpr std::uint64_t kPc2HeaderSize = 32;
inline constexpr std::uint64_t kMddHeaderSize = 8;  // without the times
inline constexpr std::uint64_t kPointSize = 12;

struct PointCacheLayout {
  std::endian order = std::endian::little;
  std::uint32_t point_count = 0;
  std::uint32_t frame_count = 0;
  std::uint64_t data_offset = 0;
  std::uint32_t first_frame_number = 0;  // 0 where the file gives no whole number
  double frames_per_second = 24.0;       // 24 where the file does not tell

  std::uint64_t frame_size() const { return kPointSize * point_count; }
  std::uint64_t frame_offset(std::uint32_t frame) const { return data_offset + frame * frame_size(); }
};

// Reads the header and checks it against the size of the file. Errors: kTruncated for a file that ends in its header
// or before its last frame (frame, counted from 0, and byte are named); kBadInput for a header that breaks a rule, no
// points, no frames, or bytes after the last frame; kUnsupported for another version.
Result<PointCacheLayout> read_point_cache_layout(InputFile& file, PointCacheFormat format);

}  // namespace limber
