// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <gtest/gtest.h>
#include <string>

#include "limber/clip/clip.h"
#include "limber/fourface/build_four_k.h"
#include "limber/fourface/front.h"
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
    EXPECT_LE(height(mesh).clusters, 2.5 * std::log2(mesh.finest_count)) << name;
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

}  // namespace
}  // namespace limber
