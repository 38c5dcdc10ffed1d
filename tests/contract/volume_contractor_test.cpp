// SPDX-License-Identifier: Apache-2.0
#include "limber/contract/volume_contractor.h"

#include <algorithm>
#include <gtest/gtest.h>

#include "limber/contract/contract.h"
#include "tests/support/shapes.h"
#include "tests/support/topology.h"

namespace limber {
namespace {

using test::Shape;

constexpr ContractOptions kByVolume{.quadrics = {}, .placement = Placement::kVolume};
constexpr ContractOptions kFreelyByVolume{.topology = Topology::kFree, .quadrics = {}, .placement = Placement::kVolume};

Simplified simplified(const Shape& shape, Index vertex_count, const ContractOptions& options = kByVolume) {
  return simplify(shape.mesh, shape.positions, vertex_count, options);
}

Vec3d normal_of(const std::vector<Vec3f>& positions, const Triangle& t) {
  const Vec3d a = static_cast<Vec3d>(positions[t[0]]);
  return cross(static_cast<Vec3d>(positions[t[1]]) - a, static_cast<Vec3d>(positions[t[2]]) - a);
}

double area_of(const Mesh& mesh, const std::vector<Vec3f>& positions) {
  double area = 0;
  for (const Triangle& t : mesh.triangles) area += 0.5 * length(normal_of(positions, t));
  return area;
}

double volume_of(const Mesh& mesh, const std::vector<Vec3f>& positions) {
  double volume = 0;
  for (const Triangle& t : mesh.triangles)
    volume += dot(normal_of(positions, t), static_cast<Vec3d>(positions[t[0]])) / 6;
  return volume;
}

// A closed box of 3 x 3 x 1 cubes' faces, `fine` squares to the length of a cube, its height scaled.
Shape box(Index fine, float height) {
  const auto side = [&](Index columns, Index rows, auto&& place) {
    return moved(test::sheet(columns * fine + 1, rows * fine + 1),
                 [&](Vec3f p) { return place(p.x / static_cast<float>(fine), p.y / static_cast<float>(fine)); });
  };
  Shape all;
  for (const Shape& s : {side(3, 3,
                              [&](float x, float y) {
                                return Vec3f{x, y, height};
                              }),
                         side(3, 3,
                              [&](float x, float y) {
                                return Vec3f{y, x, 0};
                              }),
                         side(3, 1,
                              [&](float x, float y) {
                                return Vec3f{x, 0, y * height};
                              }),
                         side(3, 1,
                              [&](float x, float y) {
                                return Vec3f{3 - x, 3, y * height};
                              }),
                         side(3, 1,
                              [&](float x, float y) {
                                return Vec3f{3, x, y * height};
                              }),
                         side(3, 1, [&](float x, float y) {
                           return Vec3f{0, 3 - x, y * height};
                         })})
    all = test::together(all, s, 0);
  std::vector<Index> kept(all.positions.size());
  Shape welded{{0, all.mesh.triangles}, {}};
  for (Index v = 0; v < all.positions.size(); ++v) {
    const auto same = std::find_if(welded.positions.begin(), welded.positions.end(),
                                   [&](const Vec3f& p) { return length(p - all.positions[v]) < 1e-4f * height; });
    kept[v] = static_cast<Index>(same - welded.positions.begin());
    if (same == welded.positions.end()) welded.positions.push_back(all.positions[v]);
  }
  for (Triangle& t : welded.mesh.triangles)
    for (Index& corner : t) corner = kept[corner];
  welded.mesh.vertex_count = static_cast<Index>(welded.positions.size());
  return welded;
}

TEST(VolumeContractor, ReachesExactlyTheVertexCountAskedFor) {
  const Shape ball = test::jittered(test::sphere(3), 0.01f, 1);
  for (const Index target : {258u, 257u, 100u, 17u, 4u}) {
    const Simplified result = simplified(ball, target);
    EXPECT_EQ(result.mesh.vertex_count, target);
    EXPECT_EQ(result.mesh.triangles.size(), 2 * target - 4);
    EXPECT_TRUE(test::same_shape(test::invariants_of(result.mesh.triangles), test::invariants_of(ball.mesh.triangles)));
  }
}

TEST(VolumeContractor, KeepsTheVolumeOfAClosedSurface) {
  for (const Shape& shape : {test::sphere(4), test::jittered(test::sphere(4), 0.01f, 2), test::torus(30, 60)}) {
    const double volume = volume_of(shape.mesh, shape.positions);
    const auto change = [&](Index target) {
      const Simplified result = simplified(shape, target);
      EXPECT_EQ(result.mesh.vertex_count, target);
      return std::abs(volume_of(result.mesh, result.positions) / volume - 1);
    };
    EXPECT_LT(change(700), 1e-4);
    EXPECT_LT(change(200), 1.5e-3);
    EXPECT_LT(change(60), 1.5e-2);
  }
}

TEST(VolumeContractor, IsCloserToASphereThanQuadrics) {
  const Shape ball = test::jittered(test::sphere(5), 0.0002f, 3);
  const auto squared_error = [&](const Simplified& made) {
    double sum = 0, area = 0;
    for (const Triangle& t : made.mesh.triangles) {
      const double weight = length(normal_of(made.positions, t));
      for (int i = 0; i < 6; ++i) {
        for (int j = 0; i + j < 6; ++j) {
          const Vec3f p = made.positions[t[0]] * (static_cast<float>(3 * i + 1) / 18) +
                          made.positions[t[1]] * (static_cast<float>(3 * j + 1) / 18) +
                          made.positions[t[2]] * (static_cast<float>(16 - 3 * i - 3 * j) / 18);
          sum += weight * (length(p) - 1) * (length(p) - 1);
          area += weight;
        }
      }
    }
    return sum / area;
  };
  EXPECT_LT(squared_error(simplified(ball, 200)), 0.75 * squared_error(simplified(ball, 200, {})));
}

TEST(VolumeContractor, LeavesABoxItsEightCorners) {
  for (const float height : {1.0f, 0.02f}) {
    const Simplified result = simplified(box(4, height), 8);
    ASSERT_EQ(result.mesh.vertex_count, 8u);
    EXPECT_EQ(result.mesh.triangles.size(), 12u);
    for (const Vec3f& p : result.positions) {
      EXPECT_NEAR(std::min(std::abs(p.x), std::abs(p.x - 3)), 0, 1e-3);
      EXPECT_NEAR(std::min(std::abs(p.y), std::abs(p.y - 3)), 0, 1e-3);
      EXPECT_NEAR(std::min(std::abs(p.z), std::abs(p.z - height)), 0, 1e-5);
    }
  }
}

TEST(VolumeContractor, KeepsTheRimOfAThinRoundPlate) {
  // Where a plate retracts it loses next to no volume: that alone would not hold its rim.
  const Shape plate = moved(test::sphere(5), [](Vec3f p) { return Vec3f{p.x, p.y, p.z * 0.004f}; });
  const Simplified result = simplified(plate, 60);
  ASSERT_EQ(result.mesh.vertex_count, 60u);
  EXPECT_GT(area_of(result.mesh, result.positions), 0.95 * area_of(plate.mesh, plate.positions));
}

TEST(VolumeContractor, KeepsTheBorderOfAFlatSheet) {
  for (const Shape& flat : {test::sheet(21, 11), test::sheet_with_hole(22, 16)}) {
    const double area = area_of(flat.mesh, flat.positions);
    for (const Index target : {60u, 20u, 8u}) {
      const Simplified result = simplified(flat, target);
      ASSERT_EQ(result.mesh.vertex_count, target);
      EXPECT_TRUE(
          test::same_shape(test::invariants_of(result.mesh.triangles), test::invariants_of(flat.mesh.triangles)));
      EXPECT_NEAR(area_of(result.mesh, result.positions), area, 2e-3) << target;
      for (const Vec3f& p : result.positions) EXPECT_NEAR(p.z, 0, 1e-6);
      for (const Triangle& t : result.mesh.triangles) EXPECT_GT(normal_of(result.positions, t).z, 0);
    }
  }
}

TEST(VolumeContractor, KeepsTheAreaWithinABentBorder) {
  Shape disc = test::sheet(41, 41, [](Index x, Index y) {
    const int a = static_cast<int>(x) - 20, b = static_cast<int>(y) - 20;
    return a * a + b * b < 300;
  });
  const Simplified result = simplified(disc, 40);
  EXPECT_NEAR(area_of(result.mesh, result.positions) / area_of(disc.mesh, disc.positions), 1, 3e-3);
}

TEST(VolumeContractor, DoesNotFoldAFlatSheetOver) {
  const Shape flat = test::jittered(test::sheet(30, 30), 0.3f, 9);
  const Shape pressed = moved(flat, [](Vec3f p) { return Vec3f{p.x, p.y, 0}; });
  for (const Index target : {300u, 80u, 40u}) {
    const Simplified result = simplified(pressed, target);
    for (const Triangle& t : result.mesh.triangles) EXPECT_GE(normal_of(result.positions, t).z, 0) << target;
  }
}

TEST(VolumeContractor, KeepsHolesAndHandlesUntilNothingIsLeftToTake) {
  for (const Shape& shape : {test::waved(test::sheet_with_hole(16, 16)), test::torus(12, 30)}) {
    const Simplified result = simplified(shape, 1);
    EXPECT_TRUE(
        test::same_shape(test::invariants_of(result.mesh.triangles), test::invariants_of(shape.mesh.triangles)));
    EXPECT_LT(result.mesh.vertex_count, 12u);
  }
}

TEST(VolumeContractor, GoesFurtherWhereTheTopologyIsFree) {
  const Shape shape = test::together(test::torus(8, 12), test::waved(test::sheet_with_hole(9, 9)), 20);
  VolumeContractor careful(shape.mesh, shape.positions, kByVolume), free(shape.mesh, shape.positions, kFreelyByVolume);
  EXPECT_GT(careful.contract_to(1), 10u);
  EXPECT_EQ(free.contract_to(1), 2u) << "components are never joined";
}

TEST(VolumeContractor, IsAsGoodAtScalesThatAreNoPowersOfTwo) {
  const Shape ball = test::jittered(test::sphere(4), 0.002f, 8);
  const double volume = volume_of(ball.mesh, ball.positions);
  for (const float scale : {1e-3f, 0.7f, 1e4f}) {
    const Simplified result = simplified(moved(ball, [&](Vec3f p) { return p * scale; }), 80);
    EXPECT_EQ(result.mesh.vertex_count, 80u);
    for (const Vec3f& p : result.positions) EXPECT_NEAR(length(p) / scale, 1.02, 0.04);
    EXPECT_NEAR(volume_of(result.mesh, result.positions) / volume / std::pow(scale, 3.0), 1, 2e-3);
  }
}

TEST(VolumeContractor, KeepsItsPlaceFarFromTheOrigin) {
  const Vec3f far{1e4f, -2e4f, 3e4f};
  const Simplified result = simplified(moved(test::sphere(3), [&](Vec3f p) { return p * 10 + far; }), 60);
  for (const Vec3f& p : result.positions) EXPECT_NEAR(length(p - far), 10, 0.6);
}

TEST(VolumeContractor, TakesTrianglesThatAreThereTwiceOrFaceBothWays) {
  Shape shape = test::jittered(test::sphere(3), 0.01f, 11);
  for (std::size_t t = 0; t < 40; ++t) shape.mesh.triangles.push_back(shape.mesh.triangles[t * 3]);
  for (std::size_t t = 0; t < shape.mesh.triangles.size(); t += 2)
    std::swap(shape.mesh.triangles[t][0], shape.mesh.triangles[t][1]);
  const Simplified result = simplified(shape, 60);
  for (const Vec3f& p : result.positions) EXPECT_NEAR(length(p), 1, 0.4);
  EXPECT_LT(simplified(shape, 60, kFreelyByVolume).mesh.vertex_count, 61u);
}

TEST(VolumeContractor, StopsWhereItIsToldTo) {
  const Shape ball = test::sphere(5);
  for (const int asked : {0, 3, 12}) {
    int left = asked;
    VolumeContractor contractor(ball.mesh, ball.positions, kByVolume, [&] { return left-- > 0; });
    if (!contractor.is_cancelled()) contractor.contract_to(4);
    EXPECT_TRUE(contractor.is_cancelled());
    EXPECT_EQ(left, -1) << "it is not asked again";
  }
}

}  // namespace
}  // namespace limber
