// SPDX-License-Identifier: Apache-2.0
#include "tool/frame_bytes.h"

namespace limber::tool {
namespace {

double mean(std::size_t sum, std::uint32_t count) { return count > 0 ? static_cast<double>(sum) / count : 0.0; }

}  // namespace

ChunkSizes& operator+=(ChunkSizes& sum, const ChunkSizes& sizes) {
  sum.hierarchy += sizes.hierarchy;
  sum.finest_positions += sizes.finest_positions;
  sum.coarser_positions += sizes.coarser_positions;
  sum.errors += sizes.errors;
  sum.overhead += sizes.overhead;
  return sum;
}

std::string frame_bytes_line(const ChunkSizes& sum, std::uint32_t frame_count) {
  return fmt::format(
      "{:.0f} per frame: hierarchy {:.0f}, finest positions {:.0f}, coarser positions {:.0f}, errors {:.0f}, "
      "overhead {:.0f}",
      mean(sum.total(), frame_count), mean(sum.hierarchy, frame_count), mean(sum.finest_positions, frame_count),
      mean(sum.coarser_positions, frame_count), mean(sum.errors, frame_count), mean(sum.overhead, frame_count));
}

Json frame_bytes_json(const ChunkSizes& sum, std::uint32_t frame_count) {
  return {{"hierarchy", mean(sum.hierarchy, frame_count)},
          {"finest_positions", mean(sum.finest_positions, frame_count)},
          {"coarser_positions", mean(sum.coarser_positions, frame_count)},
          {"errors", mean(sum.errors, frame_count)},
          {"overhead", mean(sum.overhead, frame_count)},
          {"total", mean(sum.total(), frame_count)}};
}

double bits_per_vertex(std::uint64_t bytes, Index vertex_count, std::uint32_t frame_count) {
  const double positions = static_cast<double>(vertex_count) * frame_count;
  return positions > 0 ? 8.0 * static_cast<double>(bytes) / positions : 0.0;
}

}  // namespace limber::tool
