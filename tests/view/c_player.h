// SPDX-License-Identifier: Apache-2.0
// The player's C interface as tests use it: what owns its objects, and what it draws, to be compared.
#pragma once

#include <cstddef>
#include <gtest/gtest.h>
#include <memory>
#include <optional>
#include <vector>

#include "limber/player.h"
#include "limber/view/cut.h"
#include "limber/view/extract.h"
#include "limber/view/player.h"
#include "limber/view/view.h"
#include "tests/view/player_stream.h"

namespace limber::test {

struct Destroy {
  void operator()(limber_player* player) const { limber_player_destroy(player); }
  void operator()(limber_cut* cut) const { limber_cut_destroy(cut); }
};
using OwnedPlayer = std::unique_ptr<limber_player, Destroy>;
using OwnedCut = std::unique_ptr<limber_cut, Destroy>;

inline OwnedPlayer new_player() { return OwnedPlayer(limber_player_create()); }

inline limber_info info_of(const OwnedPlayer& player) {
  limber_info info = LIMBER_INFO_INIT;
  EXPECT_EQ(limber_get_info(player.get(), &info), LIMBER_OK);
  return info;
}

inline OwnedPlayer player_of(const Bytes& bytes) {
  OwnedPlayer player = new_player();
  EXPECT_EQ(limber_append(player.get(), bytes.data(), bytes.size()), LIMBER_OK) << limber_error(player.get());
  return player;
}

inline limber_cut_options by_vertices(std::uint32_t budget) {
  limber_cut_options options = LIMBER_CUT_DEFAULTS;
  options.by = LIMBER_BY_VERTICES;
  options.budget = budget;
  return options;
}

inline constexpr std::size_t kFinestCount = 12 * 13;  // vertices of make_stream()

// All that a mesh gives, to be compared.
struct Drawn {
  std::vector<Vec3f> positions, normals;
  std::vector<Index> indices, nodes, labels;
  std::uint32_t frame, swap_count;

  friend bool operator==(const Drawn&, const Drawn&) = default;
};

inline Drawn drawn(const limber_mesh& mesh) {
  const auto vectors = [&](const float* from) {
    std::vector<Vec3f> list;
    for (std::size_t v = 0; v < mesh.vertex_count; ++v) list.push_back({from[3 * v], from[3 * v + 1], from[3 * v + 2]});
    return list;
  };
  return {vectors(mesh.positions),
          vectors(mesh.normals),
          {mesh.indices, mesh.indices + 3 * std::size_t{mesh.triangle_count}},
          {mesh.nodes, mesh.nodes + mesh.vertex_count},
          {mesh.labels, mesh.labels + kFinestCount},
          mesh.frame,
          mesh.swap_count};
}

inline Drawn cut_now(limber_cut* cut, const limber_cut_options& options) {
  limber_mesh mesh = LIMBER_MESH_INIT;
  EXPECT_EQ(limber_cut_update(cut, &options, &mesh), LIMBER_OK);
  return drawn(mesh);
}

// What the C++ player gives for every frame.
inline std::vector<Drawn> play_in_cpp(const Bytes& bytes, const CutOptions& options,
                                      const std::optional<View>& view = std::nullopt) {
  Player player;
  EXPECT_TRUE(player.open(bytes));
  Cut cut(player.mesh(), player.state().hierarchy, options);
  ExtractScratch scratch;
  MeshBuffers buffers;
  std::vector<Drawn> frames;
  for (std::uint32_t frame = 0; frame < player.available_frames(); ++frame) {
    EXPECT_TRUE(player.seek(frame));
    if (view)
      cut.update(player.mesh(), player.state(), *view);
    else
      cut.update(player.mesh(), player.state());
    extract(player.mesh(), player.state(), cut, scratch, buffers);
    const auto labels = cut.labels().first(kFinestCount);
    frames.push_back({buffers.positions,
                      buffers.normals,
                      buffers.indices,
                      buffers.nodes,
                      {labels.begin(), labels.end()},
                      frame,
                      static_cast<std::uint32_t>(player.state().swaps.size())});
  }
  return frames;
}

// Plays all of the stream.
inline void expect_frames(const Bytes& bytes, const limber_cut_options& options, const std::vector<Drawn>& expected) {
  const OwnedPlayer player = player_of(bytes);
  const OwnedCut cut(limber_cut_create(player.get()));
  for (std::uint32_t frame = 0; frame < kFrameCount; ++frame) {
    ASSERT_EQ(limber_step(player.get()), LIMBER_OK);
    ASSERT_EQ(cut_now(cut.get(), options), expected[frame]) << "frame " << frame;
  }
  EXPECT_EQ(limber_step(player.get()), LIMBER_NEEDS_MORE);
  EXPECT_EQ(limber_shown_frame(player.get()), kFrameCount - 1);
}

}  // namespace limber::test
