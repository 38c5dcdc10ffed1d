// SPDX-License-Identifier: Apache-2.0
// Four-face files with any bytes. Checksums are made right first: else nothing would get past them. Of whatever is
// decoded, every operation must be one that a front can reverse and apply again, in every frame.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <vector>

#include "fuzz/seal_chunks.h"
#include "limber/fourface/front.h"
#include "limber/stream/four_k_clip.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto input = std::as_bytes(std::span(data, size));
  std::vector<std::byte> bytes(input.begin(), input.end());
  limber::seal_chunks(bytes);
  limber::FourKClip clip;
  if (!clip.open(bytes)) return 0;
  const limber::FourKMesh& mesh = clip.mesh();
  limber::Front front(mesh);
  front.move([](limber::Index) { return false; });
  if (front.triangles().size() != mesh.finest_count) std::abort();
  front.move([](limber::Index) { return true; });
  if (front.changes() != mesh.operation_count()) std::abort();
  for (std::uint32_t frame = 0; frame < clip.decoder().frame_count(); ++frame) {
    if (!clip.go_to(frame)) return 0;
    for (limber::Index o = 0; o < mesh.operation_count(); ++o) {
      if (!(mesh.error[o] >= 0)) std::abort();
      for (const limber::Index t : mesh.destroyed_by(o))
        if (mesh.creator[t] != limber::kNone && mesh.error[mesh.creator[t]] > mesh.error[o]) std::abort();
    }
  }
  return 0;
}
