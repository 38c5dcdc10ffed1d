// SPDX-License-Identifier: Apache-2.0
// Reclustering of captured, simulated and hand-made clips: every invariant after every frame.
#include <algorithm>
#include <gtest/gtest.h>
#include <ostream>

#include "limber/clip/clip.h"
#include "limber/hierarchy/build.h"
#include "limber/hierarchy/recluster.h"
#include "limber/hierarchy/validate.h"
#include "tests/support/data.h"

namespace limber {
namespace {

struct Case {
  std::string name;
  Topology topology;
  int stride;  // every so many frames are taken
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

std::string title(const testing::TestParamInfo<Case>& info) {
  std::string text = info.param.name + (info.param.topology == Topology::kFree ? "_free" : "_preserve");
  std::replace(text.begin(), text.end(), '-', '_');
  return text;
}

class RealClip : public testing::TestWithParam<Case> {};

TEST_P(RealClip, IsFollowedByASoundHierarchyThatIsBetterThanTheFirst) {
  const Case& c = GetParam();
  LIMBER_DATA_SET(folder, c.name);
  auto reader = open_clip(folder.string(), {});
  ASSERT_TRUE(reader) << reader.error().line();
  const Mesh& mesh = (*reader)->mesh();
  std::vector<Vec3f> positions(mesh.vertex_count);
  ASSERT_TRUE(*(*reader)->read(positions));

  BuildOptions build_options;
  build_options.contract.topology = c.topology;
  const std::span<const Vec3f> frames[] = {positions};
  const Hierarchy base = build_hierarchy(mesh, frames, build_options);
  ASSERT_GE(base.level_count(), 2u);
  Validator validator(mesh, c.topology);
  Reclusterer follows(mesh, base, {.topology = c.topology, .quadrics = {}, .growth = {}});
  // The same base without swaps after the first frame.
  Reclusterer stays(mesh, base,
                    {.topology = c.topology, .quadrics = {}, .growth = {}, .threshold = 1e9, .restart = {.jump = 0}});

  Hierarchy replayed = base;
  double followed = 0, stayed = 0;
  std::size_t swap_count = 0;
  int frame = 0;
  do {
    if (frame % c.stride != 0) continue;
    for (const Swap& swap : follows.step(positions)) apply(replayed, swap), swap_count += frame > 0;
    ASSERT_EQ(replayed, follows.hierarchy()) << "frame " << frame;
    const auto violation = validator(follows.hierarchy());
    ASSERT_FALSE(violation) << "frame " << frame << ": " << violation->line();
    Box box;
    for (const Vec3f& p : positions) box.add(static_cast<Vec3d>(p));
    for (Index node = 0; node < base.node_count(); ++node) {
      ASSERT_TRUE(is_finite(follows.positions()[node]) && std::isfinite(follows.errors()[node]));
      ASSERT_LT(length(static_cast<Vec3d>(follows.positions()[node]) - box.center()), 0.6 * box.diagonal());
    }
    stays.step(positions);
    followed += follows.total_error(1), stayed += stays.total_error(1);
  } while (++frame, *(*reader)->read(positions));

  EXPECT_GT(frame, 8);
  EXPECT_GT(swap_count, 0u);
  EXPECT_LT(followed, stayed);
  EXPECT_GT(follows.growth(), 1.0);
  // Where many components stop shrinking before the levels do, the fit is steeper than any surface.
  EXPECT_LT(follows.growth(), c.name == "chickenCrossing" || c.name == "ict-face" ? 4.1 : 2.6);
  RecordProperty("growth", std::to_string(follows.growth()));
}

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const auto& [name, stride] : std::vector<std::pair<std::string, int>>{{"horse-gallop", 1},
                                                                             {"horse-collapse", 1},
                                                                             {"cloth-drop", 1},
                                                                             {"chickenCrossing", 1},
                                                                             {"walking-cat", 1},
                                                                             {"elephant-gallop", 8},
                                                                             {"crane", 12},
                                                                             {"pcow", 17},
                                                                             {"ocean", 10},
                                                                             {"ict-face", 8},
                                                                             {"cat-poses", 2},
                                                                             {"face-poses", 4}})
    for (const Topology topology : {Topology::kPreserve, Topology::kFree}) all.push_back({name, topology, stride});
  return all;
}

INSTANTIATE_TEST_SUITE_P(Clips, RealClip, testing::ValuesIn(cases()), title);

}  // namespace
}  // namespace limber
