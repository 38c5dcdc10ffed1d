// SPDX-License-Identifier: Apache-2.0
// Contraction of meshes as people have them: holes, bow-ties, non-manifold edges, repeated and degenerate faces.
#include <algorithm>
#include <cctype>
#include <gtest/gtest.h>

#include "limber/clip/mesh_file.h"
#include "limber/contract/contract.h"
#include "limber/contract/edges.h"
#include "limber/hierarchy/build.h"
#include "limber/hierarchy/validate.h"
#include "tests/support/data.h"

namespace limber {
namespace {

class RealMesh : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    LIMBER_DATA_SET(folder, "static");
    Result<MeshFile> read = read_mesh(folder / GetParam());
    ASSERT_TRUE(read) << read.error().line();
    file = std::move(*read);
  }
  MeshFile file;
};

double area_of(const std::vector<Triangle>& triangles, const std::vector<Vec3f>& positions) {
  double area = 0;
  for (const auto& [a, b, c] : triangles)
    area += 0.5 * length(cross(static_cast<Vec3d>(positions[b]) - static_cast<Vec3d>(positions[a]),
                               static_cast<Vec3d>(positions[c]) - static_cast<Vec3d>(positions[a])));
  return area;
}

TEST_P(RealMesh, GoesToATenthAndToAHundredthInBothTopologies) {
  Box box;
  for (const Vec3f& p : file.positions) box.add(static_cast<Vec3d>(p));
  const double area = area_of(file.mesh.triangles, file.positions);
  const std::span<const Vec3f> frames[] = {file.positions};
  Index reached[2][2];
  for (const Topology topology : {Topology::kPreserve, Topology::kFree}) {
    Contractor contractor(file.mesh, frames, {.topology = topology, .quadrics = {}, .fold_over_cosine = 0.2});
    const Index vertex_count = contractor.vertex_count();
    for (const bool coarse : {false, true}) {
      const Index target = coarse ? vertex_count * 3 / 200 : vertex_count / 10;
      const Index count = contractor.contract_to(target);
      reached[topology == Topology::kFree][coarse] = count;
      if (topology == Topology::kFree) EXPECT_LE(count, std::max<Index>(target, 50));  // a vertex for each component
      const Simplified result = simplified_mesh(contractor, file.mesh, 0);
      ASSERT_EQ(result.positions.size(), result.mesh.vertex_count);
      EXPECT_LE(result.mesh.vertex_count, count);
      if (topology == Topology::kPreserve) EXPECT_GT(result.mesh.triangles.size(), 0u);
      for (const Vec3f& p : result.positions) {
        ASSERT_TRUE(is_finite(p));
        const double off = std::max(
            {box.low.x - p.x, box.low.y - p.y, box.low.z - p.z, p.x - box.high.x, p.y - box.high.y, p.z - box.high.z});
        ASSERT_LT(off, 0.08 * box.diagonal()) << "a spike";
      }
      if (!coarse && topology == Topology::kPreserve)
        EXPECT_NEAR(area_of(result.mesh.triangles, result.positions) / area, 1, 0.25);
    }
  }
  for (const bool coarse : {false, true}) EXPECT_LE(reached[1][coarse], reached[0][coarse]);
}

TEST_P(RealMesh, GoesToATenthByVolumePlacement) {
  Box box;
  for (const Vec3f& p : file.positions) box.add(static_cast<Vec3d>(p));
  const double area = area_of(file.mesh.triangles, file.positions);
  for (const Topology topology : {Topology::kPreserve, Topology::kFree}) {
    const ContractOptions by_quadrics{.topology = topology, .quadrics = {}};
    const ContractOptions by_volume{.topology = topology, .quadrics = {}, .placement = Placement::kVolume};
    const Index target = start_contraction(file.mesh, file.positions, by_volume)->vertex_count() / 10;
    const Simplified usual = simplify(file.mesh, file.positions, target, by_quadrics);
    const Simplified result = simplify(file.mesh, file.positions, target, by_volume);
    EXPECT_LE(result.mesh.vertex_count, std::max(target, usual.mesh.vertex_count + usual.mesh.vertex_count / 50 + 4));
    for (const Vec3f& p : result.positions) {
      ASSERT_TRUE(is_finite(p));
      const double off = std::max(
          {box.low.x - p.x, box.low.y - p.y, box.low.z - p.z, p.x - box.high.x, p.y - box.high.y, p.z - box.high.z});
      ASSERT_LT(off, 0.08 * box.diagonal()) << "a spike";
    }
    if (topology == Topology::kPreserve) EXPECT_NEAR(area_of(result.mesh.triangles, result.positions) / area, 1, 0.3);
  }
}

TEST_P(RealMesh, HasASoundHierarchyInBothTopologies) {
  const std::span<const Vec3f> frames[] = {file.positions};
  for (const Topology topology : {Topology::kPreserve, Topology::kFree}) {
    BuildOptions options;
    options.contract.topology = topology;
    const Hierarchy h = build_hierarchy(file.mesh, frames, options);
    const auto violation = Validator(file.mesh, topology)(h);
    EXPECT_FALSE(violation) << violation->line();
    EXPECT_GE(h.level_count(), 2u);
  }
}

INSTANTIATE_TEST_SUITE_P(Static, RealMesh,
                         testing::Values("stanford-bunny.obj", "cow.obj", "teapot.obj", "truck-nonmanifold.obj",
                                         "beetle.obj", "polygon_mesh.off", "blobby-shuffled.off",
                                         "camel-ref-sumner.obj", "mountain.obj", "fandisk.obj", "cessna.obj",
                                         "sword-quad-dominant.obj", "lucy100k.ply"),
                         [](const auto& p) {
                           std::string name = p.param;
                           for (char& c : name)
                             if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
                           return name;
                         });

}  // namespace
}  // namespace limber
