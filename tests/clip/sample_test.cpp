// SPDX-License-Identifier: Apache-2.0
#include "limber/clip/sample.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace limber {
namespace {

using ::testing::HasSubstr;

struct Clip {
  Mesh mesh;
  std::vector<std::vector<Vec3f>> frames;
};

Clip read_clip(const std::string& specification) {
  auto reader = open_sample(specification);
  EXPECT_TRUE(reader) << specification;
  Clip clip;
  if (!reader) return clip;
  clip.mesh = (*reader)->mesh();
  std::vector<Vec3f> positions(clip.mesh.vertex_count);
  while (*(*reader)->read(positions)) clip.frames.push_back(positions);
  return clip;
}

// Opening a creature takes a second, so clips that several tests look at are read once.
const Clip& clip_of(const std::string& specification) {
  static std::map<std::string, Clip> clips;
  const auto [entry, is_new] = clips.try_emplace(specification);
  if (is_new) entry->second = read_clip(specification);
  return entry->second;
}

struct Topology {
  std::size_t edge_count = 0, border_count = 0;
  bool is_manifold = true;  // every directed edge once, every vertex with one fan
};

Topology topology_of(const Mesh& mesh) {
  Topology topology;
  std::set<std::pair<Index, Index>> directed;
  std::vector<std::map<Index, Index>> fans(mesh.vertex_count);
  for (const Triangle& triangle : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Index a = triangle[i], b = triangle[(i + 1) % 3], c = triangle[(i + 2) % 3];
      if (!directed.insert({a, b}).second) topology.is_manifold = false;
      fans[a][b] = c;
    }
  }
  for (const auto& [a, b] : directed) {
    const bool is_border = !directed.contains({b, a});
    topology.border_count += is_border;
    topology.edge_count += is_border || a < b;
  }
  for (const auto& fan : fans) {
    if (fan.empty()) {
      topology.is_manifold = false;
      continue;
    }
    // Start where no triangle comes before, if the fan is open.
    std::set<Index> ends;
    for (const auto& [from, to] : fan) ends.insert(to);
    Index start = fan.begin()->first;
    for (const auto& [from, to] : fan) {
      if (!ends.contains(from)) start = from;
    }
    std::size_t steps = 0;
    Index at = start;
    for (auto next = fan.find(at); next != fan.end() && steps < fan.size(); next = fan.find(at)) {
      at = next->second;
      ++steps;
      if (at == start) break;
    }
    if (steps != fan.size()) topology.is_manifold = false;
  }
  return topology;
}

int euler_characteristic(const Mesh& mesh) {
  return static_cast<int>(mesh.vertex_count) - static_cast<int>(topology_of(mesh).edge_count) +
         static_cast<int>(mesh.triangles.size());
}

double volume(const Mesh& mesh, const std::vector<Vec3f>& x) {
  double sum = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    sum += dot(static_cast<Vec3d>(x[a]), cross(static_cast<Vec3d>(x[b]), static_cast<Vec3d>(x[c]))) / 6.0;
  }
  return sum;
}

// Twice the area over the square of the longest side: 0.87 for an equilateral triangle, 0 for a degenerate one.
double quality(const Triangle& t, const std::vector<Vec3f>& x) {
  const Vec3d a(x[t[0]]), b(x[t[1]]), c(x[t[2]]);
  const double longest = std::max({squared_length(b - a), squared_length(c - b), squared_length(a - c)});
  return longest > 0.0 ? length(cross(b - a, c - a)) / longest : 0.0;
}

// The share of edges whose lengths in the two frames differ by more than a tenth.
double stretched_share(const Mesh& mesh, const std::vector<Vec3f>& x, const std::vector<Vec3f>& y) {
  std::size_t stretched = 0;
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Index a = t[i], b = t[(i + 1) % 3];
      const double before = length(static_cast<Vec3d>(x[b]) - static_cast<Vec3d>(x[a]));
      const double after = length(static_cast<Vec3d>(y[b]) - static_cast<Vec3d>(y[a]));
      stretched += std::fabs(after - before) > 0.1 * before;
    }
  }
  return static_cast<double>(stretched) / (3.0 * static_cast<double>(mesh.triangles.size()));
}

std::uint64_t checksum(const Clip& clip) {
  std::uint64_t hash = 14695981039346656037u;
  const auto add = [&](std::uint32_t word) { hash = (hash ^ word) * 1099511628211u; };
  for (const Triangle& triangle : clip.mesh.triangles) {
    for (const Index corner : triangle) add(corner);
  }
  for (const auto& frame : clip.frames) {
    for (const Vec3f& p : frame) {
      for (const float value : {p.x, p.y, p.z}) add(std::bit_cast<std::uint32_t>(value));
    }
  }
  return hash;
}

const char* const kCreatures[] = {"collapse", "gallop", "morph"};
std::string small(const std::string& name) { return "sample:" + name + "?vertices=2500&frames=12"; }

TEST(Sample, EveryListedNameOpensWithTheCountsOfTheHeader) {
  EXPECT_EQ(samples().size(), 4u);
  for (const SampleInfo& info : samples()) {
    EXPECT_FALSE(info.description.empty());
    const auto reader = open_sample("sample:" + std::string(info.name));
    ASSERT_TRUE(reader) << info.name;
    EXPECT_EQ((*reader)->mesh().vertex_count, 10000u);
    EXPECT_EQ((*reader)->frame_count(), 60u);
  }
}

TEST(Sample, VertexAndFrameCountsAreExactlyThoseAskedFor) {
  for (const std::string name : kCreatures) {
    for (const std::uint32_t count : {100u, 333u, 2500u}) {
      const Clip& clip = clip_of("sample:" + name + "?frames=12&vertices=" + std::to_string(count));
      EXPECT_EQ(clip.mesh.vertex_count, count) << name;
      EXPECT_EQ(clip.frames.size(), 12u);
    }
  }
  for (std::uint32_t count = 100; count < 3000; count += 37) {
    const auto reader = open_sample("sample:flag?vertices=" + std::to_string(count));
    ASSERT_TRUE(reader);
    EXPECT_EQ((*reader)->mesh().vertex_count, count);
    const Topology topology = topology_of((*reader)->mesh());
    EXPECT_TRUE(topology.is_manifold) << count;
    EXPECT_EQ(euler_characteristic((*reader)->mesh()), 1) << count;
  }
}

TEST(Sample, TheMorphHasTheSizeOfTheMorphOfThePapers) {
  const auto reader = open_sample("sample:morph?vertices=17489&frames=200");
  ASSERT_TRUE(reader);
  EXPECT_EQ((*reader)->mesh().vertex_count, 17489u);
  EXPECT_EQ((*reader)->frame_count(), 200u);
  EXPECT_EQ(euler_characteristic((*reader)->mesh()), 2);
}

TEST(Sample, CreaturesAreClosedManifoldSpheresAtEverySize) {
  for (const std::string name : kCreatures) {
    for (const std::uint32_t count : {100u, 333u, 2500u}) {
      const Clip& clip = clip_of("sample:" + name + "?frames=12&vertices=" + std::to_string(count));
      const Topology topology = topology_of(clip.mesh);
      EXPECT_TRUE(topology.is_manifold) << name << " " << count;
      EXPECT_EQ(topology.border_count, 0u) << name << " " << count;
      EXPECT_EQ(euler_characteristic(clip.mesh), 2) << name << " " << count;
    }
  }
}

TEST(Sample, CreaturesLookOutwards) {
  for (const std::string name : kCreatures) {
    const Clip& clip = clip_of(small(name));
    EXPECT_GT(volume(clip.mesh, clip.frames[0]), 0.1) << name;
  }
}

TEST(Sample, TheFirstFrameHasNoDegenerateTriangle) {
  for (const SampleInfo& info : samples()) {
    const Clip& clip = clip_of(small(std::string(info.name)));
    for (const Triangle& triangle : clip.mesh.triangles) {
      EXPECT_GT(quality(triangle, clip.frames[0]), 1e-4) << info.name;
    }
  }
}

TEST(Sample, AFlagIsOneSheetWithOneBorderHeldAtThePole) {
  const Clip& clip = clip_of(small("flag"));
  EXPECT_TRUE(topology_of(clip.mesh).is_manifold);
  EXPECT_GT(topology_of(clip.mesh).border_count, 150u);
  std::size_t held = 0;
  for (Index v = 0; v < clip.mesh.vertex_count; ++v) {
    const auto rests = [&](const std::vector<Vec3f>& frame) {
      return length(static_cast<Vec3d>(frame[v]) - static_cast<Vec3d>(clip.frames[0][v])) < 1e-6;
    };
    held += std::all_of(clip.frames.begin(), clip.frames.end(), rests);
  }
  EXPECT_GT(held, 30u);
  EXPECT_LT(held, 100u);
}

TEST(Sample, EveryFrameIsFiniteAndOfThisWorld) {
  for (const SampleInfo& info : samples()) {
    for (const auto& frame : clip_of(small(std::string(info.name))).frames) {
      for (const Vec3f& p : frame) ASSERT_TRUE(is_finite(p) && length(p) < 10.0f) << info.name;
    }
  }
}

TEST(Sample, MotionsAreStronglyNonRigid) {
  for (const auto& [name, share] : {std::pair{"collapse", 0.1}, {"gallop", 0.05}, {"morph", 0.7}}) {
    const Clip& clip = clip_of(small(name));
    double most = 0.0;
    for (const auto& frame : clip.frames) most = std::fmax(most, stretched_share(clip.mesh, clip.frames[0], frame));
    EXPECT_GT(most, share) << name;
  }
  // A flag bends and hardly stretches: its extent changes instead.
  const Clip& flag = clip_of(small("flag"));
  double moved = 0.0;
  for (Index v = 0; v < flag.mesh.vertex_count; ++v) {
    moved = std::fmax(moved, length(static_cast<Vec3d>(flag.frames[0][v]) - static_cast<Vec3d>(flag.frames[9][v])));
  }
  EXPECT_GT(moved, 0.2);
}

TEST(Sample, TheCollapseEndsFlatOnTheFloor) {
  const Clip& clip = clip_of(small("collapse"));
  Box first, last;
  for (const Vec3f& p : clip.frames.front()) first.add(static_cast<Vec3d>(p));
  for (const Vec3f& p : clip.frames.back()) last.add(static_cast<Vec3d>(p));
  EXPECT_LT(last.high.y - last.low.y, 0.45 * (first.high.y - first.low.y));
  EXPECT_GT(last.low.y, -0.1);
}

TEST(Sample, TheGallopRepeatsToTheLastBit) {
  const Clip& clip = clip_of("sample:gallop?vertices=333&frames=60");
  ASSERT_EQ(clip.frames.size(), 60u);
  for (std::size_t frame = 0; frame < 30; ++frame) EXPECT_EQ(clip.frames[frame], clip.frames[frame + 30]) << frame;
  EXPECT_NE(clip.frames[0], clip.frames[15]);
}

TEST(Sample, RewindStartsAgainAndTheEndLeavesThePositionsAlone) {
  auto reader = open_sample("sample:flag?frames=3&vertices=200");
  ASSERT_TRUE(reader);
  std::vector<Vec3f> first(200), positions(200);
  ASSERT_TRUE(*(*reader)->read(first));
  ASSERT_TRUE(*(*reader)->read(positions));
  ASSERT_TRUE(*(*reader)->read(positions));
  const std::vector<Vec3f> last = positions;
  EXPECT_FALSE(*(*reader)->read(positions));
  EXPECT_EQ(positions, last);
  ASSERT_TRUE((*reader)->rewind());
  ASSERT_TRUE(*(*reader)->read(positions));
  EXPECT_EQ(positions, first);
}

TEST(Sample, TheBytesAreTheSameOnEveryPlatform) {
  EXPECT_EQ(checksum(clip_of(small("collapse"))), 5629009987148053491u);
  EXPECT_EQ(checksum(clip_of(small("gallop"))), 8184293964907431535u);
  EXPECT_EQ(checksum(clip_of(small("morph"))), 3338117022162242954u);
  EXPECT_EQ(checksum(clip_of(small("flag"))), 14674169873402662343u);
}

TEST(Sample, AWrongSpecificationIsRefusedInOneLineThatSaysWhatIsAllowed) {
  for (const char* specification :
       {"", "sample", "sample:", "sample:horse", "sample:flag?", "sample:flag?vertices",
        "sample:flag?vertices=", "sample:flag?vertices=99", "sample:flag?vertices=5000001", "sample:flag?vertices=1e4",
        "sample:flag?vertices=-5", "sample:flag?vertices=99999999999999999999", "sample:flag?frames=0",
        "sample:flag?frames=100001", "sample:flag?frames=5&frames=6", "sample:flag?frames=5&", "sample:flag?size=3",
        "sample:flag?frames=5 "}) {
    const auto reader = open_sample(specification);
    ASSERT_FALSE(reader) << specification;
    EXPECT_EQ(reader.error().code, ErrorCode::kBadInput);
    EXPECT_THAT(reader.error().line(), HasSubstr("sample:collapse, sample:gallop, sample:morph or sample:flag"));
    EXPECT_EQ(reader.error().line().find('\n'), std::string::npos);
  }
}

}  // namespace
}  // namespace limber
