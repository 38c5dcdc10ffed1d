// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <random>
#include <string>

#include "limber/clip/clip.h"
#include "limber/fourface/build_four_k.h"
#include "limber/fourface/front.h"
#include "limber/fourface/front_request.h"
#include "tests/support/data.h"

namespace limber {
namespace {

// Of the mesh in a file, and valid.
FourKMesh built(const std::filesystem::path& path) {
  auto clip = open_clip(path.string(), {});
  EXPECT_TRUE(clip) << path;
  const Mesh& mesh = (*clip)->mesh();
  std::vector<Vec3f> positions(mesh.vertex_count);
  EXPECT_TRUE((*clip)->read(positions));
  FourKMesh made = build_four_k(mesh, positions, {});
  EXPECT_EQ(validate(made, positions), nullptr) << path;
  return made;
}

// The slides' ratios per level are .655 to .692.
TEST(RealFourK, LosesAThirdOfTheTrianglesPerLevelAndHasLogarithmicHeight) {
  LIMBER_DATA_SET(folder, "static");
  for (const char* const name :
       {"stanford-bunny.obj", "cow.obj", "mountain.obj", "nefertiti-70k.obj", "lucy100k.ply"}) {
    const FourKMesh mesh = built(folder / name);
    EXPECT_LE(height(mesh).operations, 2.5 * std::log2(mesh.finest_count)) << name;
    double before = mesh.finest_count;
    for (Index level = 1; level <= 8; ++level) {
      const auto now = static_cast<double>(triangles_after(mesh, mesh.level_begin[level]).size());
      EXPECT_GE(now / before, 0.62) << name << " " << level;
      EXPECT_LE(now / before, 0.72) << name << " " << level;
      before = now;
    }
  }
}

TEST(RealFourK, HoldsWhatCannotBeSimplifiedAsItIs) {
  LIMBER_DATA_SET(folder, "static");
  for (const char* const name :
       {"truck-nonmanifold.obj", "blobby-shuffled.off", "teapot.obj", "beetle.obj", "cessna.obj"}) {
    const FourKMesh mesh = built(folder / name);
    EXPECT_GT(mesh.operation_count(), 0u) << name;
  }
}

// Which triangles face away from the input's surface around each of their corners.
struct Facing {
  Facing(const FourKMesh& mesh, std::span<const Vec3f> points) : positions(points), normals(mesh.vertex_count) {
    for (Index t = 0; t < mesh.finest_count; ++t)
      for (const Index corner : mesh.triangles[t]) normals[corner] += area_of(mesh.triangles[t]);
  }
  Vec3d area_of(const Triangle& t) const {
    const auto p = static_cast<Vec3d>(positions[t[0]]);
    return cross(static_cast<Vec3d>(positions[t[1]]) - p, static_cast<Vec3d>(positions[t[2]]) - p);
  }
  bool is_turned(const Triangle& t) const {
    const Vec3d area = area_of(t);
    return dot(area, normals[t[0]]) < 0 && dot(area, normals[t[1]]) < 0 && dot(area, normals[t[2]]) < 0;
  }

  std::span<const Vec3f> positions;
  std::vector<Vec3d> normals;
};

struct RealMesh {
  explicit RealMesh(const std::filesystem::path& path) : mesh(built(path)) {
    auto clip = open_clip(path.string(), {});
    positions.resize((*clip)->mesh().vertex_count);
    EXPECT_TRUE((*clip)->read(positions));
  }
  FourKMesh mesh;
  std::vector<Vec3f> positions;
};

// No triangle of any front faces away from the surface around all of its corners, but for those of the input that do.
void expect_fronts_that_do_not_fold(const RealMesh& real, int count) {
  const FourKMesh& mesh = real.mesh;
  const Facing facing(mesh, real.positions);
  const float largest = *std::max_element(mesh.error.begin(), mesh.error.end());
  std::mt19937 random(5);
  Front front(mesh);
  FrontRequest request;
  for (int i = 0; i < count; ++i) {
    if (i % 10 == 0) {
      const auto at = static_cast<Vec3d>(real.positions[random() % real.positions.size()]);
      request = {};
      const double error = static_cast<double>(largest) * std::pow(2.0, -static_cast<double>(random() % 14));
      if (i % 30 == 0) request.error = error;
      if (i % 30 == 10)
        request.focus = Ball{at, error * static_cast<double>(1 + random() % 200)}, request.error = error / 8;
      if (i % 30 == 20) request.triangles = 20 + static_cast<Index>(random() % mesh.finest_count);
    } else if (request.error) {
      *request.error *= 1.05;
    } else {
      *request.triangles -= *request.triangles / 50;
    }
    move_front(front, mesh, real.positions, request);
    ASSERT_TRUE(std::ranges::none_of(front.triangles(), [&](Index t) {
      return t >= mesh.finest_count && facing.is_turned(mesh.triangles[t]);
    })) << i;
  }
}

TEST(RealFourK, FoldsNothingOverIn1000FrontsThatTheInputDoesNot) {
  LIMBER_DATA_SET(folder, "static");
  for (const char* const name : {"stanford-bunny.obj", "cow.obj", "mountain.obj", "fandisk.obj", "lucy100k.ply"})
    expect_fronts_that_do_not_fold(RealMesh(folder / name), 200);
}

}  // namespace
}  // namespace limber
