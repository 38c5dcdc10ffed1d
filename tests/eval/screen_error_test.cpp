// SPDX-License-Identifier: Apache-2.0
#include "eval/screen_error.h"

#include <algorithm>
#include <gtest/gtest.h>

#include "limber/clip/clip.h"
#include "limber/stream/build_stream.h"
#include "limber/view/cut.h"
#include "limber/view/player.h"
#include "limber/view/triangle_list.h"

namespace limber::eval {
namespace {

TEST(ScreenError, OfAPlateThatIsOffIsTheDistanceInPixelsAtItsDepth) {
  const std::vector<Triangle> triangles = {{0, 1, 2}, {0, 2, 3}};
  const std::vector<Vec3f> plate = {{-9, -9, 0}, {9, -9, 0}, {9, 9, 0}, {-9, 9, 0}};
  std::vector<Vec3f> off = plate;
  for (Vec3f& p : off) p.z -= 0.5f;
  const Surface original{triangles, plate}, drawn{triangles, off};
  const ClosestPointTree original_tree(original), drawn_tree(drawn);
  const limber::View view{.camera = Camera{.eye = {0, 0, 10}, .fov_degrees = 90}, .width = 400, .height = 400};
  const ScreenError error = measure_screen_error(original, original_tree, drawn, drawn_tree, view, 1000);
  EXPECT_NEAR(error.to_drawn, 200 / 10.0 * 0.5, 1e-6);
  EXPECT_NEAR(error.to_original, 200 / 10.5 * 0.5, 1e-6);
  EXPECT_EQ(error.largest(), error.to_drawn);
  EXPECT_GT(error.point_count, 2000u);
}

TEST(ScreenError, LooksAtWhatLiesInThePictureOnly) {
  const std::vector<Triangle> triangles = {{0, 1, 2}, {3, 4, 5}};
  const std::vector<Vec3f> positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {50, 0, 0}, {51, 0, 0}, {50, 1, 0}};
  std::vector<Vec3f> off = positions;
  off[3].z = off[4].z = off[5].z = 7;
  const Surface original{triangles, positions}, drawn{triangles, off};
  const limber::View view{.camera = Camera{.eye = {0, 0, 10}, .fov_degrees = 60}};
  const ScreenError error =
      measure_screen_error(original, ClosestPointTree(original), drawn, ClosestPointTree(drawn), view, 1000);
  EXPECT_EQ(error.largest(), 0);
}

// A small part of what limber_screen_bench does on real clips.
TEST(ScreenError, OfACutByPixelsIsNeverMoreThanPromisedAndMostlyNotMuchLess) {
  auto clip = open_clip("sample:collapse?vertices=1500&frames=5", {});
  ASSERT_TRUE(clip);
  std::vector<std::byte> bytes;
  const auto built = build_stream(**clip, {}, [&](std::span<const std::byte> more) -> Result<void> {
    bytes.insert(bytes.end(), more.begin(), more.end());
    return {};
  });
  ASSERT_TRUE(built) << built.error().line();
  Player player;
  ASSERT_TRUE(player.open(bytes));
  const Mesh& mesh = player.mesh();
  Cut cut(mesh, player.state().hierarchy, {.by = CutBy::kError});
  TriangleList list;
  std::vector<double> shares;
  std::uint64_t seed = 0;
  while (shares.size() < 60) {
    ASSERT_TRUE(player.seek(static_cast<std::uint32_t>(shares.size() / 12)));
    const FrameState& state = player.state();
    const Surface original{mesh.triangles, std::span(state.positions).first(mesh.vertex_count)};
    const limber::View view = random_view(bounding_box(original), ++seed);
    const double pixels = random_pixels(seed);
    cut.set_options({.by = CutBy::kError, .error_bound = static_cast<float>(pixels)});
    cut.update(mesh, state, view);
    list_triangles(mesh, cut.labels(), list);
    const Surface drawn{list.triangles, state.positions};
    const ScreenError error =
        measure_screen_error(original, ClosestPointTree(original), drawn, ClosestPointTree(drawn), view, 20'000);
    if (error.point_count < 500) continue;
    EXPECT_LE(error.largest(), pixels) << "seed " << seed;
    EXPECT_LE(cut.seen_error(), pixels);
    shares.push_back(error.largest() / pixels);
  }
  std::sort(shares.begin(), shares.end());
  EXPECT_GE(shares[30], 0.25);  // so small a mesh is often shown as coarse, or as fine, as it can be
}

}  // namespace
}  // namespace limber::eval
