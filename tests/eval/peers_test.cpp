// SPDX-License-Identifier: Apache-2.0
// Other projects' methods; a test of one that this build does not have says that it skips.
#include "eval/peers/peers.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <set>

#include "eval/methods/quadric_error.h"
#include "limber/clip/clip.h"
#include "tests/eval/shapes.h"

// Declares `info`, or skips the test and says so.
#define LIMBER_PEER(info, name)                     \
  const MethodInfo* const info = find_method(name); \
  if (info == nullptr) GTEST_SKIP() << "built without " << package_of_peer(name)

namespace limber::eval {
namespace {

constexpr const char* kCgal[] = {"cgal-garland-heckbert", "cgal-lindstrom-turk"};

struct Clip {
  Mesh mesh;
  std::vector<std::vector<Vec3f>> frames;
};

Clip read_clip(const char* specification) {
  const auto reader = open_clip(specification, {});
  Clip clip{(*reader)->mesh(), {}};
  std::vector<Vec3f> positions(clip.mesh.vertex_count);
  while (*(*reader)->read(positions)) clip.frames.push_back(positions);
  return clip;
}

Approximation simplify(const MethodInfo& info, const Clip& clip, std::size_t t, const MethodOptions& options) {
  const auto method = info.create(options);
  const std::span<const Vec3f> seen[] = {clip.frames[0]};
  method->begin(clip.mesh, seen);
  Approximation made;
  method->frame(clip.frames[t], made);
  return made;
}

// Triangles as a set, each from its smallest corner on.
std::multiset<Triangle> as_set(std::span<const Triangle> triangles) {
  std::multiset<Triangle> set;
  for (Triangle t : triangles) {
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    set.insert(t);
  }
  return set;
}

TEST(Peers, StandBehindOursAndAreMarked) {
  std::set<std::string_view> names;
  for (const MethodInfo& peer : peers()) {
    EXPECT_TRUE(peer.peer);
    EXPECT_TRUE(peer.frames_are_independent);
    EXPECT_NE(package_of_peer(peer.name), "");
    names.insert(peer.name);
  }
  const auto first = std::ranges::find_if(methods(), &MethodInfo::peer);
  for (auto info = first; info != methods().end(); ++info) EXPECT_TRUE(names.contains(info->name));
  EXPECT_EQ(static_cast<std::size_t>(methods().end() - first), names.size());
  EXPECT_EQ(package_of_peer("direct"), "");
}

TEST(Peers, MeshoptimizerGivesVerticesOfTheInput) {
  LIMBER_PEER(info, "meshoptimizer");
  const Clip clip = read_clip("sample:gallop?vertices=1000&frames=3");
  for (std::size_t t = 0; t < 3; ++t) {
    const Approximation made = simplify(*info, clip, t, {.vertices = 150});
    EXPECT_GE(made.positions.size(), 149u);
    EXPECT_LE(made.positions.size(), 150u);
    EXPECT_TRUE(made.clusters.empty());
    for (std::size_t i = 0; i < made.nodes.size(); ++i) EXPECT_EQ(made.positions[i], clip.frames[t][made.nodes[i]]);
  }
}

TEST(Peers, MeshoptimizerKeepsToTheVerticesOfASurfaceWithABorder) {
  LIMBER_PEER(info, "meshoptimizer");
  const Clip clip = read_clip("sample:flag?vertices=900&frames=2");
  const Approximation made = simplify(*info, clip, 1, {.vertices = 100});
  EXPECT_GE(made.positions.size(), 98u);
  EXPECT_LE(made.positions.size(), 100u);
}

TEST(Peers, CgalTellsItsClusters) {
  for (const char* const name : kCgal) {
    LIMBER_PEER(info, name);
    for (const char* const specification :
         {"sample:gallop?vertices=600&frames=2", "sample:flag?vertices=600&frames=2"}) {
      SCOPED_TRACE(std::string(name) + ", " + specification);
      const Clip clip = read_clip(specification);
      const Approximation made = simplify(*info, clip, 1, {.vertices = 100});
      EXPECT_EQ(made.positions.size(), 100u);
      ASSERT_EQ(made.clusters.size(), clip.mesh.vertex_count);
      EXPECT_EQ(std::set<Index>(made.clusters.begin(), made.clusters.end()),
                std::set<Index>(made.nodes.begin(), made.nodes.end()));
      // What is left of the mesh when each vertex is replaced by its cluster is the approximation.
      std::vector<Triangle> left, named;
      for (Triangle t : clip.mesh.triangles) {
        for (Index& corner : t) corner = made.clusters[corner];
        if (!is_degenerate(t)) left.push_back(t);
      }
      name_corners(made, named);
      EXPECT_EQ(as_set(left), as_set(named));
    }
  }
}

TEST(Peers, CgalIsAboutAsGoodAsOurs) {
  const Clip clip = read_clip("sample:gallop?vertices=600&frames=2");
  QuadricError error(clip.mesh, {});
  const Approximation ours = simplify(*find_method("direct"), clip, 1, {.vertices = 100});
  for (const char* const name : kCgal) {
    LIMBER_PEER(info, name);
    const double its = error.measure(clip.frames[1], simplify(*info, clip, 1, {.vertices = 100}).clusters);
    EXPECT_LT(its, 3 * error.measure(clip.frames[1], ours.clusters)) << name;
  }
}

TEST(Peers, CgalLeavesIsolatedVerticesAlone) {
  for (const char* const name : kCgal) {
    LIMBER_PEER(info, name);
    Clip clip = read_clip("sample:gallop?vertices=300&frames=1");
    const Approximation before = simplify(*info, clip, 0, {.triangles = 100});
    clip.mesh.vertex_count += 2;
    clip.frames[0].resize(clip.mesh.vertex_count, Vec3f{9, 9, 9});
    const Approximation made = simplify(*info, clip, 0, {.triangles = 100});
    EXPECT_EQ(made.triangles, before.triangles) << name;
    EXPECT_EQ(made.positions, before.positions) << name;
    EXPECT_EQ(made.clusters.back(), clip.mesh.vertex_count - 1) << name;
  }
}

TEST(Peers, CgalDoesNotSupportWhatAHalfEdgeStructureCannotHold) {
  for (const char* const name : kCgal) {
    LIMBER_PEER(info, name);
    EXPECT_TRUE(info->supports({4, {{0, 1, 2}, {0, 2, 3}}}));
    const Result<void> supported = info->supports({5, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}});
    ASSERT_FALSE(supported);
    EXPECT_EQ(supported.error().code, ErrorCode::kBadInput);
  }
}

TEST(Peers, OursSupportEveryMesh) {
  for (const MethodInfo& info : methods()) {
    if (info.peer) continue;
    EXPECT_TRUE(info.supports({5, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}})) << info.name;
  }
}

}  // namespace
}  // namespace limber::eval
