// SPDX-License-Identifier: Apache-2.0
#include "eval/light_buffer.h"

#include <algorithm>
#include <tbb/parallel_for.h>

namespace limber::eval {

LightBuffer::LightBuffer(const Scene& scene, const Studio& studio)
    : width_(scene.options.width), height_(scene.options.height), extent_(static_cast<float>(scene.extent)) {
  entries_.resize(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
  const SamplePattern center = sample_pattern(1);
  const std::size_t tile_count = scene.bins.offsets.size() - 1;
  std::vector<std::vector<Receiver>> receivers_of(tile_count);
  std::vector<std::vector<std::size_t>> entries_of(tile_count);
  tbb::parallel_for(std::size_t{0}, tile_count, [&](std::size_t index) {
    TileSamples tile;
    const std::span<const Index> items =
        std::span(scene.bins.items)
            .subspan(scene.bins.offsets[index], scene.bins.offsets[index + 1] - scene.bins.offsets[index]);
    if (items.empty()) return;
    clear_tile(scene.bins, index, width_, height_, center.count, tile);
    draw_tile(scene.subject.triangles, scene.points, items, center, scene.near, tile);
    for (int y = tile.pixels.y0; y < tile.pixels.y1; ++y) {
      for (int x = tile.pixels.x0; x < tile.pixels.x1; ++x) {
        const Index t = tile.triangle[tile.offset(x, y)];
        if (t == kNone) continue;
        const Fragment f = fragment_at(scene, t, x + 0.5, y + 0.5);
        const std::size_t entry =
            static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
        entries_[entry].inverse_depth = f.inverse_depth;
        entries_[entry].normal = f.normal;
        entries_of[index].push_back(entry);
        receivers_of[index].push_back({f.position, f.facing, f.normal});
      }
    }
  });
  std::vector<Receiver> receivers;
  for (const auto& some : receivers_of) receivers.insert(receivers.end(), some.begin(), some.end());
  const std::vector<Reached> reached =
      reached_light(scene.subject.triangles, scene.subject.positions, studio.lights, receivers);
  std::size_t next = 0;
  for (const auto& some : entries_of) {
    for (const std::size_t entry : some) entries_[entry].reached = reached[next++];
  }
}

Reached LightBuffer::at(int x, int y, const Fragment& fragment) const {
  Reached sum{0.0f, 0.0f};
  float weight_sum = 0.0f;
  const float depth = 1.0f / std::max(fragment.inverse_depth, 1e-30f);
  for (int j = std::max(0, y - 1); j <= std::min(height_ - 1, y + 1); ++j) {
    for (int i = std::max(0, x - 1); i <= std::min(width_ - 1, x + 1); ++i) {
      const Entry& entry =
          entries_[static_cast<std::size_t>(j) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(i)];
      if (entry.inverse_depth <= 0.0f) continue;
      const float apart = (1.0f / entry.inverse_depth - depth) / (0.004f * extent_ + 1e-30f);
      const float aligned = std::max(0.05f, dot(entry.normal, fragment.normal));
      const float central = static_cast<float>((i == x ? 2 : 1) * (j == y ? 2 : 1));
      const float weight = central * aligned * aligned / (0.02f + apart * apart);
      sum.sky += weight * entry.reached.sky;
      sum.key += weight * entry.reached.key;
      weight_sum += weight;
    }
  }
  if (!(weight_sum > 0.0f)) return {};
  return {sum.sky / weight_sum, sum.key / weight_sum};
}

}  // namespace limber::eval
