// SPDX-License-Identifier: Apache-2.0
// Small clips with hierarchies that change, for the tests of the stream.
#pragma once

#include <bit>
#include <cstdint>
#include <gtest/gtest.h>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "limber/base/mesh.h"
#include "limber/hierarchy/hierarchy.h"
#include "limber/stream/decoder.h"
#include "limber/stream/encoder.h"
#include "tests/support/grid.h"

namespace limber::test {

struct SampleFrame {
  Hierarchy hierarchy;
  std::vector<Swap> swaps;
  std::vector<Vec3f> positions;  // [node_count]
  std::vector<float> errors;     // [node_count]
};

struct SampleClip {
  Mesh mesh;
  std::vector<SampleFrame> frames;

  std::span<const Vec3f> first_positions() const { return std::span(frames[0].positions).first(mesh.vertex_count); }
};

// A grid with everything a mesh may have: an isolated vertex, a degenerate and a repeated triangle, an edge with
// three triangles, a triangle the other way round.
inline Mesh rough_mesh() {
  Mesh mesh = grid(5, 4);
  mesh.vertex_count = 23;
  mesh.triangles.push_back({3, 3, 9});
  mesh.triangles.push_back({7, 7, 7});
  mesh.triangles.push_back(mesh.triangles[4]);
  mesh.triangles.push_back({0, 1, 21});
  mesh.triangles.push_back({6, 1, 0});
  return mesh;
}

// Every level groups `branching` nodes with neighbouring numbers.
inline Hierarchy grouped(Index vertex_count, Index branching, Index level_count) {
  Hierarchy hierarchy;
  hierarchy.level_begin = {0, vertex_count};
  for (Index level = 1; level < level_count; ++level) {
    const Index begin = hierarchy.level_begin[level - 1], end = hierarchy.level_begin[level];
    for (Index node = begin; node < end; ++node) hierarchy.parent.push_back(end + (node - begin) / branching);
    hierarchy.level_begin.push_back(hierarchy.parent.back() + 1);
  }
  hierarchy.parent.resize(hierarchy.node_count(), kNone);
  return hierarchy;
}

// Bends the mesh, without functions that differ between machines; nodes above the finest level lie near the mean of
// their children.
inline void move_nodes(SampleFrame& frame, Index frame_number, Index width) {
  const Hierarchy& h = frame.hierarchy;
  frame.positions.assign(h.node_count(), {});
  frame.errors.assign(h.node_count(), 0.0f);
  std::vector<Vec3d> sum(h.node_count());
  std::vector<double> count(h.node_count());
  for (Index node = 0; node < h.node_count(); ++node) {
    Vec3f& p = frame.positions[node];
    if (node < h.vertex_count()) {
      const auto x = static_cast<float>(node % width), y = static_cast<float>(node / width);
      const float t = static_cast<float>(frame_number);
      p = {x + 0.1f * t, y - 0.02f * t * x, 0.03f * (x - 0.4f * t) * (x - 3.0f) * (y - 2.5f)};
    } else if (count[node] > 0) {
      p = Vec3f(sum[node] * (1.0 / count[node]));
      frame.errors[node] = static_cast<float>(count[node]) * (1.0f + 0.01f * static_cast<float>(frame_number));
    }
    if (h.parent[node] == kNone) continue;
    sum[h.parent[node]] += Vec3d(p);
    count[h.parent[node]] += 1;
  }
}

// A clip over `mesh` in which some nodes of every level below the top change their parents at random in every frame.
inline SampleClip sample_clip(const Mesh& mesh, Hierarchy hierarchy, std::uint32_t frame_count) {
  SampleClip clip{mesh, {}};
  std::mt19937 random(7);
  for (std::uint32_t frame = 0; frame < frame_count; ++frame) {
    std::vector<Swap> swaps;
    for (Index level = 0; frame > 0 && level + 1 < hierarchy.level_count(); ++level) {
      const Index above = hierarchy.level_begin[level + 1];
      for (Index node = hierarchy.level_begin[level]; node < above; ++node) {
        const Swap swap{node, above + static_cast<Index>(random() % hierarchy.level_size(level + 1))};
        if (random() % 5 == 0 && swap.parent != hierarchy.parent[node]) swaps.push_back(swap);
      }
    }
    for (const Swap& swap : swaps) apply(hierarchy, swap);
    clip.frames.push_back({hierarchy, swaps, {}, {}});
    move_nodes(clip.frames.back(), frame, 5);
  }
  return clip;
}

inline SampleClip rough_clip(std::uint32_t frame_count) {
  const Mesh mesh = rough_mesh();
  return sample_clip(mesh, grouped(mesh.vertex_count, 3, 3), frame_count);
}

inline std::vector<std::byte> encode(const SampleClip& clip, const EncoderOptions& options) {
  std::vector<std::byte> bytes;
  Encoder encoder([&bytes](std::span<const std::byte> more) {
    bytes.insert(bytes.end(), more.begin(), more.end());
    return Result<void>();
  });
  auto result = encoder.begin(clip.mesh, clip.frames[0].hierarchy, clip.first_positions(), options);
  for (const SampleFrame& frame : clip.frames)
    if (result) result = encoder.add(frame.hierarchy, frame.swaps, frame.positions, frame.errors);
  if (result) result = encoder.finish();
  EXPECT_TRUE(result) << (result ? "" : result.error().line());
  return bytes;
}

inline bool same_bits(float a, float b) { return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b); }

inline bool same_state(const FrameState& a, const FrameState& b) {
  if (a.frame != b.frame || !(a.hierarchy == b.hierarchy) || a.positions.size() != b.positions.size()) return false;
  for (std::size_t i = 0; i < a.positions.size(); ++i) {
    const Vec3f &p = a.positions[i], &q = b.positions[i];
    if (!same_bits(p.x, q.x) || !same_bits(p.y, q.y) || !same_bits(p.z, q.z)) return false;
    if (!same_bits(a.errors[i], b.errors[i])) return false;
  }
  return true;
}

// All frames from the first to the last that are there. Stops at the first error, which it gives in `error`.
inline std::vector<FrameState> play(Decoder& decoder, std::string* error = nullptr) {
  std::vector<FrameState> states;
  FrameState state;
  decoder.prepare(state);
  for (std::uint32_t frame = 0; frame < decoder.available_frames(); ++frame) {
    const auto result = decoder.decode(frame, state);
    if (!result) {
      if (error) *error = result.error().line();
      break;
    }
    states.push_back(state);
  }
  return states;
}

}  // namespace limber::test
