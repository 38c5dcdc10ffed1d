// SPDX-License-Identifier: Apache-2.0
#include "limber/stream/traversal.h"

#include <algorithm>
#include <gtest/gtest.h>

#include "tests/stream/sample_clip.h"

namespace limber {
namespace {

Traversal traversal_of(const Mesh& mesh) {
  const IndexLists incident = incident_triangles(mesh);
  return traverse(mesh, incident, neighbors(mesh, incident));
}

TEST(Neighbors, OfATriangleAreItsOtherCorners) {
  const Mesh mesh{4, {{0, 2, 1}, {0, 2, 1}, {1, 1, 1}}};
  const IndexLists lists = neighbors(mesh, incident_triangles(mesh));
  EXPECT_EQ(lists.begin, (std::vector<Index>{0, 2, 4, 6, 6}));
  EXPECT_EQ(lists.data, (std::vector<Index>{2, 1, 0, 2, 0, 1}));
}

TEST(Traversal, VisitsEveryVertexOfARoughMeshOnce) {
  const Mesh mesh = test::rough_mesh();
  const Traversal traversal = traversal_of(mesh);
  std::vector<Index> sorted = traversal.order;
  std::sort(sorted.begin(), sorted.end());
  for (Index v = 0; v < mesh.vertex_count; ++v) {
    EXPECT_EQ(sorted[v], v);
    EXPECT_EQ(traversal.order[traversal.place[v]], v);
  }
}

TEST(Traversal, PredictsFromEarlierPlacesWithWeightsOfSumOne) {
  const Traversal traversal = traversal_of(test::rough_mesh());
  for (Index place = 0; place < traversal.order.size(); ++place) {
    const auto sources = traversal.sources[place];
    EXPECT_EQ(sources.empty(), place == 0);
    EXPECT_LE(sources.size(), kMostSources);
    int sum = 0;
    for (Index s = traversal.sources.begin[place]; s < traversal.sources.begin[place + 1]; ++s) {
      EXPECT_LT(traversal.sources.data[s], place);
      sum += traversal.key_weights[s];
    }
    if (place > 0) {
      EXPECT_EQ(sum, 256);
    }
  }
}

TEST(Traversal, CompletesTheParallelogram) {
  const Mesh mesh{4, {{0, 1, 2}, {2, 1, 3}}};
  const Traversal traversal = traversal_of(mesh);
  EXPECT_EQ(traversal.order, (std::vector<Index>{0, 1, 2, 3}));
  const auto sources = traversal.sources[3];
  EXPECT_EQ(std::vector<Index>(sources.begin(), sources.end()), (std::vector<Index>{2, 1, 0}));
  EXPECT_EQ(std::vector<std::int16_t>(traversal.key_weights.end() - 3, traversal.key_weights.end()),
            (std::vector<std::int16_t>{256, 256, -256}));
}

TEST(Traversal, OfAFanTakesLinearTime) {
  Mesh fan;
  fan.vertex_count = 200000;
  for (Index v = 2; v < fan.vertex_count; ++v) fan.triangles.push_back({0, 1, v});
  EXPECT_EQ(traversal_of(fan).order.size(), fan.vertex_count);
}

}  // namespace
}  // namespace limber
