// SPDX-License-Identifier: Apache-2.0
// What blending does to a real clip, by measures that the player does not have.
#include "limber/view/blend.h"

#include <gtest/gtest.h>

#include "eval/distance.h"
#include "limber/base/triangles.h"
#include "limber/clip/clip.h"
#include "limber/hierarchy/build.h"
#include "limber/hierarchy/recluster.h"
#include "limber/view/extract.h"
#include "tests/support/data.h"

namespace limber::eval {
namespace {

std::vector<Triangle> images(const Mesh& mesh, std::span<const Index> labels) {
  std::vector<Triangle> images;
  list_images(mesh.triangles, labels, images);
  return images;
}

// A blend, and the sum over the frames of what popped: the distance between what it shows and what it would show if
// nothing went on, the labels and means of the frame before where the nodes are now.
class Popping {
 public:
  Popping(const Mesh& mesh, const Hierarchy& hierarchy, Index frames)
      : mesh_(mesh), blend_(mesh, hierarchy, {.frames = frames}) {}

  void update(const FrameState& state, const Cut& cut) {
    const std::vector<Triangle> before = images(mesh_, blend_.labels().empty() ? cut.labels() : blend_.labels());
    std::vector<Vec3f> moved(state.positions);
    moved.resize(std::size_t{blend_.node_count()} + blend_.path_count());
    for (Index i = 0; i < blend_.path_count(); ++i) {
      for (const auto& [node, weight] : blend_.shares(i))
        moved[blend_.node_count() + i] += weight * state.positions[node];
    }
    blend_.update(state, cut);
    const std::vector<Triangle> now = images(mesh_, blend_.labels());
    popped_ += measure_distance({before, moved}, {now, blend_.positions()}, kSamples).rms;
    const Surface original{mesh_.triangles, std::span(state.positions).first(mesh_.vertex_count)};
    rms_ += measure_distance(original, {now, blend_.positions()}, kSamples).rms;
    moving_count_ += blend_.moving_count();
  }

  double popped() const { return popped_; }
  double rms() const { return rms_; }
  std::size_t moving_count() const { return moving_count_; }

 private:
  static constexpr DistanceOptions kSamples{.samples = {.per_triangle = 2, .at_least = 20'000}};

  const Mesh& mesh_;
  Blend blend_;
  double popped_ = 0, rms_ = 0;
  std::size_t moving_count_ = 0;
};

TEST(BlendOfAClip, PopsLessAndStaysCloseToTheSurface) {
  LIMBER_DATA_SET(folder, "horse-gallop");
  const auto clip = open_clip(folder.string(), {});
  ASSERT_TRUE(clip);
  const Mesh& mesh = (*clip)->mesh();
  std::vector<Vec3f> positions(mesh.vertex_count);
  ASSERT_TRUE(*(*clip)->read(positions));
  const std::span<const Vec3f> seen[] = {positions};
  // Without births: the place of a node that is born elsewhere says nothing about where the frame before would be now.
  ReclusterOptions options;
  options.rebirth.hysteresis = 0;
  Reclusterer reclusterer(mesh, build_hierarchy(mesh, seen, {.branching = 8, .level_sizes = {800, 100}}), options);

  FrameState state;
  Cut cut(mesh, reclusterer.hierarchy(), {.by = CutBy::kLevel, .level = 1});
  Popping at_once(mesh, reclusterer.hierarchy(), 0), blended(mesh, reclusterer.hierarchy(), 4);
  for (state.frame = 0; state.frame < 8; ++state.frame) {
    reclusterer.step(positions);
    state.hierarchy = reclusterer.hierarchy();
    state.positions.assign(reclusterer.positions().begin(), reclusterer.positions().end());
    state.errors.assign(reclusterer.errors().begin(), reclusterer.errors().end());
    cut.update(mesh, state);
    at_once.update(state, cut);
    blended.update(state, cut);
    ASSERT_TRUE(*(*clip)->read(positions));
  }
  EXPECT_GT(blended.moving_count(), 100u);
  EXPECT_LT(blended.popped(), 0.75 * at_once.popped());
  EXPECT_LT(blended.rms(), 1.2 * at_once.rms());
}

}  // namespace
}  // namespace limber::eval
