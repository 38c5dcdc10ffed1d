// SPDX-License-Identifier: Apache-2.0
#include "limber/clip/point_cache_layout.h"

#include <array>
#include <cmath>
#include <fmt/format.h>
#include <string_view>

#include "limber/clip/byte_order.h"

namespace limber {
namespace {

using namespace std::string_view_literals;

constexpr std::uint32_t kLargestCount = 0x7fffffff;

std::uint32_t whole_number_or_zero(double value) {
  const bool is_whole = value >= 0 && value < static_cast<double>(kLargestCount) && value == std::floor(value);
  return is_whole ? static_cast<std::uint32_t>(value) : 0;
}

Result<void> check_size(const InputFile& file, const PointCacheLayout& layout) {
  if (layout.point_count == 0 || layout.point_count > kLargestCount || layout.frame_count == 0 ||
      layout.frame_count > kLargestCount) {
    return Error{ErrorCode::kBadInput, file.name(),
                 fmt::format("its header gives {} points and {} frames", static_cast<std::int32_t>(layout.point_count),
                             static_cast<std::int32_t>(layout.frame_count))};
  }
  // Counting whole frames cannot overflow, unlike the size that the header promises.
  const std::uint64_t data_size = file.size() - std::min(file.size(), layout.data_offset);
  const std::uint64_t whole_frames = data_size / layout.frame_size();
  if (whole_frames < layout.frame_count) {
    return Error{ErrorCode::kTruncated, fmt::format("{}, frame {}, byte {}", file.name(), whole_frames, file.size()),
                 fmt::format("the file ends here, but its header promises {} frames of {} points", layout.frame_count,
                             layout.point_count)};
  }
  if (data_size != layout.frame_count * layout.frame_size()) {
    return Error{ErrorCode::kBadInput, fmt::format("{}, byte {}", file.name(), layout.frame_offset(layout.frame_count)),
                 fmt::format("the file goes on after the {} frames of {} points that its header promises",
                             layout.frame_count, layout.point_count)};
  }
  return {};
}

Result<PointCacheLayout> read_pc2_layout(InputFile& file) {
  constexpr std::endian kLittle = std::endian::little;
  std::array<char, kPc2HeaderSize> header;
  if (Result<void> done = file.read(0, header); !done) return done.error();
  if (std::string_view(header.data(), 12) != "POINTCACHE2\0"sv) {
    return Error{ErrorCode::kBadInput, file.name(), "a PC2 file must start with POINTCACHE2"};
  }
  const std::uint32_t version = load<std::uint32_t, kLittle>(&header[12]);
  if (version != 1) {
    return Error{ErrorCode::kUnsupported, file.name(), fmt::format("is PC2 of version {}; only 1 is known", version)};
  }
  PointCacheLayout layout;
  layout.order = kLittle;
  layout.point_count = load<std::uint32_t, kLittle>(&header[16]);
  layout.frame_count = load<std::uint32_t, kLittle>(&header[28]);
  layout.data_offset = kPc2HeaderSize;
  const double start = static_cast<double>(load_float<kLittle>(&header[20]));
  if (load_float<kLittle>(&header[24]) == 1.0f) layout.first_frame_number = whole_number_or_zero(start);
  if (Result<void> done = check_size(file, layout); !done) return done.error();
  return layout;
}

// The frame rate and first number that the times of the first and last frame fit, if any.
void fit_times(double first, double last, PointCacheLayout& layout) {
  if (layout.frame_count < 2) {
    const double number = first * layout.frames_per_second;
    layout.first_frame_number = whole_number_or_zero(std::round(number));
    return;
  }
  if (!(last > first) || !std::isfinite(last)) return;
  const double rate = (layout.frame_count - 1) / (last - first);
  // Times are floats: 24 frames per second come out as 23.9998.
  const double whole = std::round(rate);
  layout.frames_per_second = whole > 0 && std::abs(rate - whole) < 1e-3 * whole ? whole : rate;
  const double number = first * layout.frames_per_second;
  if (std::abs(number - std::round(number)) < 0.01) {
    layout.first_frame_number = whole_number_or_zero(std::round(number));
  }
}

Result<PointCacheLayout> read_mdd_layout(InputFile& file) {
  constexpr std::endian kBig = std::endian::big;
  std::array<char, kMddHeaderSize> header;
  if (Result<void> done = file.read(0, header); !done) return done.error();
  PointCacheLayout layout;
  layout.order = kBig;
  layout.frame_count = load<std::uint32_t, kBig>(&header[0]);
  layout.point_count = load<std::uint32_t, kBig>(&header[4]);
  layout.data_offset = kMddHeaderSize + 4 * std::uint64_t{layout.frame_count};
  if (Result<void> done = check_size(file, layout); !done) return done.error();
  std::array<char, 4> first;
  std::array<char, 4> last;
  if (Result<void> done = file.read(kMddHeaderSize, first); !done) return done.error();
  if (Result<void> done = file.read(layout.data_offset - 4, last); !done) return done.error();
  fit_times(static_cast<double>(load_float<kBig>(first.data())), static_cast<double>(load_float<kBig>(last.data())),
            layout);
  return layout;
}

}  // namespace

std::optional<PointCacheFormat> point_cache_format(const std::filesystem::path& path) {
  const std::string extension = lower_case_extension(path);
  if (extension == ".pc2") return PointCacheFormat::kPc2;
  if (extension == ".mdd") return PointCacheFormat::kMdd;
  return std::nullopt;
}

Result<PointCacheLayout> read_point_cache_layout(InputFile& file, PointCacheFormat format) {
  if (file.size() == 0) return Error{ErrorCode::kTruncated, file.name(), "the file is empty"};
  return format == PointCacheFormat::kPc2 ? read_pc2_layout(file) : read_mdd_layout(file);
}

}  // namespace limber
