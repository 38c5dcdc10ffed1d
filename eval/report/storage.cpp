// SPDX-License-Identifier: Apache-2.0
#include "eval/report/storage.h"

#include <algorithm>
#include <fmt/format.h>
#include <numeric>

#include "eval/report/words.h"

namespace limber::eval {
namespace {

constexpr double kTriangleBytes = 12, kVertexBytes = 12, kIndexBytes = 4;

StorageRow plain_row(const Contender& contender, std::size_t place) {
  const auto frame_count = static_cast<double>(contender.frames.size());
  double vertices = 0, triangles = 0;
  bool changes = false;
  for (std::size_t t = 0; t < contender.frames.size(); ++t) {
    const FrameMeasure& measured = contender.measure.frames()[t];
    vertices += contender.frames[t].vertex_count / frame_count;
    triangles += static_cast<double>(measured.quality.triangle_count) / frame_count;
    changes = changes || measured.changed.value_or(0) > 0;
  }
  StorageRow row{.what = std::string(contender.info->name),
                 .mark = MethodMark{place},
                 .how = changes ? "a triangle list and positions per frame" : "one triangle list, positions per frame",
                 .connectivity = kTriangleBytes * triangles / (changes ? 1 : frame_count),
                 .positions = kVertexBytes * vertices,
                 .total = 0};
  row.total = (*row.connectivity + *row.positions) * frame_count;
  return row;
}

void add_stream(std::vector<StorageRow>& rows, const BuildReport& stream, const Mesh& mesh) {
  const auto frame_count = static_cast<double>(stream.frame_count);
  const auto per_frame = [&](std::size_t bytes) { return static_cast<double>(bytes) / frame_count; };
  const auto node_count =
      static_cast<double>(std::accumulate(stream.level_sizes.begin(), stream.level_sizes.end(), std::uint64_t{0}));
  const auto triangle_count = static_cast<double>(mesh.triangles.size());
  rows.push_back({.what = "limber stream",
                  .mark = {},
                  .how = fmt::format("all {} levels with errors, quantised and coded, the original among them: its own "
                                     "positions {} per frame, those of coarser levels {}",
                                     stream.level_sizes.size(), byte_count(per_frame(stream.bytes.finest_positions)),
                                     byte_count(per_frame(stream.bytes.coarser_positions))),
                  .connectivity = per_frame(stream.bytes.hierarchy),
                  .positions = per_frame(stream.bytes.finest_positions + stream.bytes.coarser_positions),
                  .total = static_cast<double>(stream.stream_bytes)});
  rows.push_back({.what = "its swaps, uncoded",
                  .mark = {},
                  .how = fmt::format("two 32-bit integers for each of {} swaps per frame; no positions",
                                     number(stream.swaps.mean)),
                  .connectivity = 2 * kIndexBytes * stream.swaps.mean,
                  .positions = {},
                  .total = 2 * kIndexBytes * stream.swaps.mean * std::max(0.0, frame_count - 1)});
  const double whole = kIndexBytes * (node_count + triangle_count);
  rows.push_back({.what = "its hierarchy in every frame",
                  .mark = {},
                  .how = "a parent per node and a node per degenerate triangle; no positions",
                  .connectivity = whole,
                  .positions = {},
                  .total = whole * frame_count});
}

}  // namespace

std::vector<StorageRow> storage_rows(const Mesh& mesh, const Comparison& comparison, const BuildReport* stream) {
  const auto frame_count = static_cast<double>(comparison.contenders().front().frames.size());
  std::vector<StorageRow> rows;
  const double triangles = kTriangleBytes * static_cast<double>(mesh.triangles.size());
  const double positions = kVertexBytes * mesh.vertex_count;
  rows.push_back({.what = "the original",
                  .mark = {},
                  .how = "one triangle list, positions per frame",
                  .connectivity = triangles / frame_count,
                  .positions = positions,
                  .total = triangles + positions * frame_count});
  for (std::size_t i = 0; i < comparison.contenders().size(); ++i)
    rows.push_back(plain_row(comparison.contenders()[i], i));
  if (stream != nullptr) add_stream(rows, *stream, mesh);
  return rows;
}

}  // namespace limber::eval
