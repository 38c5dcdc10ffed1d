// SPDX-License-Identifier: Apache-2.0
#include "eval/methods/seen_frames.h"

#include <gtest/gtest.h>

#include "limber/clip/clip.h"

namespace limber::eval {
namespace {

std::unique_ptr<ClipReader> sample() { return std::move(*open_clip("sample:gallop?vertices=400&frames=9", {})); }

SeenFrames read(ClipReader& clip, std::span<const MethodInfo* const> methods) {
  return std::move(*SeenFrames::read(clip, methods, 3, [](std::uint32_t) { return true; }));
}

TEST(SeenFrames, EveryMethodGetsWhatItSees) {
  const auto clip = sample();
  std::vector<const MethodInfo*> all;
  for (const MethodInfo& info : methods()) all.push_back(&info);
  const SeenFrames seen = read(*clip, all);
  std::vector<Vec3f> first(clip->mesh().vertex_count);
  ASSERT_TRUE(*clip->read(first)) << "the clip is rewound";
  for (const MethodInfo* info : all) {
    const auto frames = seen.of(*info);
    ASSERT_EQ(frames.size(), info->sees == Sees::kFirst ? 1u : info->sees == Sees::kBase ? 3u : 9u) << info->name;
    EXPECT_TRUE(std::ranges::equal(frames[0], first)) << info->name;
  }
}

TEST(SeenFrames, MethodsOfOneConnectivityDecideByTheWholeClip) {
  for (const char* const name : {"dsd", "average", "best-cut", "pose-independent", "deformation-oriented"})
    EXPECT_EQ(find_method(name)->sees, Sees::kMany) << name;
  for (const char* const name : {"first-frame", "rest-pose"}) EXPECT_EQ(find_method(name)->sees, Sees::kFirst) << name;
}

TEST(SeenFrames, ManyIsBoundedByMemoryAndNeverLessThanTwo) {
  EXPECT_EQ(many_frames(1), 1024u);
  EXPECT_GT(many_frames(8431), 200u);
  for (const Index vertex_count : {8431u, 100'000u, 1'000'000u})
    EXPECT_LE(std::uint64_t{many_frames(vertex_count)} * vertex_count * sizeof(Quadric), std::uint64_t{1} << 28);
  EXPECT_EQ(many_frames(1u << 30), 2u);
}

}  // namespace
}  // namespace limber::eval
