// SPDX-License-Identifier: Apache-2.0
#include "limber/clip/mesh_sequence_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/clip/sample_meshes.h"
#include "tests/clip/scratch_folder.h"

namespace limber {
namespace {

TEST(MeshSequenceWriter, WritesFramesOfDifferentConnectivity) {
  const test::ScratchFolder folder;
  Result<MeshSequenceWriter> writer = MeshSequenceWriter::create(folder / "lod/%02d.ply", 5);
  ASSERT_DONE(writer);
  const std::vector<Triangle> triangles{{0, 1, 2}, {0, 2, 3}};
  const std::vector<Vec3f> positions = test::awkward_positions(4, 0);
  const std::span<const Triangle> all(triangles);
  const std::span<const Vec3f> points(positions);
  ASSERT_DONE(writer->write({all, points}));
  ASSERT_DONE(writer->write({all.first(1), points.first(3)}));
  ASSERT_DONE(writer->finish());
  EXPECT_THAT(folder.names(), testing::ElementsAre("lod", "lod/05.ply", "lod/06.ply"));
  const Result<MeshFile> file = read_mesh(folder / "lod/06.ply");
  ASSERT_DONE(file);
  EXPECT_EQ(file->mesh, (Mesh{3, {{0, 1, 2}}}));
}

TEST(MeshSequenceWriter, RefusesAnUnknownExtension) {
  EXPECT_ERROR(MeshSequenceWriter::create("a%d.stl", 0), kUnsupported,
               "frames are written as .obj, .ply or .off files");
}

}  // namespace
}  // namespace limber
