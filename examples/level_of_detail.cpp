// SPDX-License-Identifier: Apache-2.0
// Plays a stream and cuts every frame down to 800 vertices. Needs the player alone:
//   limber build sample:collapse -o collapse.limber && example_level_of_detail collapse.limber
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <span>
#include <vector>

#include "limber/view/extract.h"
#include "limber/view/player.h"

int main(int argc, char** argv) {
  if (argc != 2) return std::fprintf(stderr, "usage: level_of_detail FILE.limber\n"), 2;
  std::ifstream file(argv[1], std::ios::binary);
  const std::vector<char> bytes{std::istreambuf_iterator<char>(file), {}};

  limber::Player player;
  if (auto opened = player.open(std::as_bytes(std::span(bytes))); !opened) {
    return std::fprintf(stderr, "%s: %s\n", argv[1], opened.error().line().c_str()), 1;
  }
  limber::Cut cut(player.mesh(), player.state().hierarchy, {.by = limber::CutBy::kVertices, .budget = 800});
  limber::ExtractScratch scratch;
  limber::MeshBuffers buffers;

  for (std::uint32_t frame = 0; frame < player.available_frames(); ++frame) {
    if (auto there = player.seek(frame); !there) return std::fprintf(stderr, "%s\n", there.error().line().c_str()), 1;
    cut.update(player.mesh(), player.state());
    limber::extract(player.mesh(), player.state(), cut, scratch, buffers);
    std::printf("frame %u: %zu swaps, %u vertices, %u triangles\n", frame, player.state().swaps.size(),
                buffers.vertex_count(), buffers.triangle_count());
  }
}
