// SPDX-License-Identifier: Apache-2.0
// A clip that no file holds: a program hands its own frames to limber by deriving from ClipReader.
#include <algorithm>
#include <array>
#include <cstdio>
#include <vector>

#include "limber/clip/clip.h"

namespace {

// A square that folds along its diagonal: one more step in each frame.
class FoldingSquare final : public limber::ClipReader {
 public:
  const limber::Mesh& mesh() const override { return mesh_; }
  std::optional<std::uint32_t> frame_count() const override { return kFrameCount; }

  limber::Result<bool> read(std::span<limber::Vec3f> positions) override {
    if (next_ == kFrameCount) return false;
    const float height = 0.1f * static_cast<float>(next_++);
    const std::array<limber::Vec3f, 4> corners{{{0, 0, 0}, {1, 0, height}, {1, 1, 0}, {0, 1, height}}};
    std::copy(corners.begin(), corners.end(), positions.begin());
    return true;
  }

  limber::Result<void> rewind() override {
    next_ = 0;
    return {};
  }

 private:
  static constexpr std::uint32_t kFrameCount = 10;
  limber::Mesh mesh_{4, {{0, 1, 2}, {0, 2, 3}}};
  std::uint32_t next_ = 0;
};

}  // namespace

int main() {
  FoldingSquare clip;
  std::vector<limber::Vec3f> positions(clip.mesh().vertex_count);
  for (std::uint32_t frame = 0;; ++frame) {
    const limber::Result<bool> more = clip.read(positions);
    if (!more) return std::fprintf(stderr, "%s\n", more.error().line().c_str()), 1;
    if (!*more) break;
    limber::Box box;
    for (const limber::Vec3f& p : positions) box.add(limber::Vec3d(p));
    std::printf("frame %u: diagonal %.4f\n", frame, box.diagonal());
  }
}
