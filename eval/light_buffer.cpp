// SPDX-License-Identifier: Apache-2.0
#include "eval/light_buffer.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "eval/parallel_for.h"

namespace limber::eval {
namespace {

constexpr int kCell = 2;  // pixels; divides kTileSize
static_assert(kTileSize % kCell == 0);

// What one tile contributes.
struct TilePlaces {
  std::vector<Receiver> receivers;
  std::vector<std::size_t> entries;
};

}  // namespace

LightBuffer::LightBuffer(const Scene& scene)
    : columns_((scene.options.width + kCell - 1) / kCell),
      rows_((scene.options.height + kCell - 1) / kCell),
      extent_(static_cast<float>(scene.extent)) {
  entries_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
  const SamplePattern center = sample_pattern(1);
  std::vector<TilePlaces> places(scene.bins.offsets.size() - 1);
  parallel_for(places.size(), [&](std::size_t index) {
    const std::span<const Index> items = items_of(scene.bins, index);
    if (items.empty()) return;
    TileSamples tile;
    clear_tile(scene.bins, index, scene.options.width, scene.options.height, center.count, tile);
    draw_tile(scene.subject.triangles, scene.points, items, center, scene.near, tile);
    for (int y = tile.pixels.y0; y < tile.pixels.y1; ++y) {
      for (int x = tile.pixels.x0; x < tile.pixels.x1; ++x) {
        const Index t = tile.triangle[tile.offset(x, y)];
        const std::size_t index_of_entry = static_cast<std::size_t>(y / kCell) * static_cast<std::size_t>(columns_) +
                                           static_cast<std::size_t>(x / kCell);
        Entry& entry = entries_[index_of_entry];
        // The first pixel of the cell that shows anything stands for it.
        if (t == kNone || entry.inverse_depth > 0.0f) continue;
        const Fragment f = fragment_at(scene, t, x + 0.5, y + 0.5);
        entry.inverse_depth = f.inverse_depth;
        entry.normal = f.normal;
        places[index].entries.push_back(index_of_entry);
        places[index].receivers.push_back({f.position, f.facing, f.normal});
      }
    }
  });
  for (const TilePlaces& some : places) {
    receivers_.insert(receivers_.end(), some.receivers.begin(), some.receivers.end());
    entry_of_.insert(entry_of_.end(), some.entries.begin(), some.entries.end());
  }
}

void LightBuffer::set_reached(std::span<const Reached> reached) {
  assert(reached.size() == receivers_.size());
  for (std::size_t i = 0; i < reached.size(); ++i) entries_[entry_of_[i]].reached = reached[i];
}

Reached LightBuffer::at(int x, int y, const Fragment& fragment) const {
  Reached sum{0.0f, 0.0f};
  float weight_sum = 0.0f;
  const float depth = 1.0f / std::max(fragment.inverse_depth, 1e-30f);
  const float tolerance = 1.0f / (0.004f * extent_ + 1e-30f);
  const int column = x / kCell, row = y / kCell;
  // The weights fall off linearly around the pixel, so that cells do not show.
  const float off_x = (static_cast<float>(x % kCell) + 0.5f) / kCell - 0.5f;
  const float off_y = (static_cast<float>(y % kCell) + 0.5f) / kCell - 0.5f;
  for (int j = std::max(0, row - 1); j <= std::min(rows_ - 1, row + 1); ++j) {
    const float weight_y = 1.5f - std::fabs(static_cast<float>(j - row) - off_y);
    for (int i = std::max(0, column - 1); i <= std::min(columns_ - 1, column + 1); ++i) {
      const Entry& entry =
          entries_[static_cast<std::size_t>(j) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(i)];
      if (entry.inverse_depth <= 0.0f) continue;
      const float weight_x = 1.5f - std::fabs(static_cast<float>(i - column) - off_x);
      const float apart = (1.0f / entry.inverse_depth - depth) * tolerance;
      const float aligned = std::max(0.05f, dot(entry.normal, fragment.normal));
      const float weight = weight_x * weight_y * aligned * aligned / (0.02f + apart * apart);
      sum.sky += weight * entry.reached.sky;
      sum.key += weight * entry.reached.key;
      weight_sum += weight;
    }
  }
  if (!(weight_sum > 0.0f)) return {};
  return {sum.sky / weight_sum, sum.key / weight_sum};
}

}  // namespace limber::eval
