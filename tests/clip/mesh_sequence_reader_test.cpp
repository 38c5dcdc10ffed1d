// SPDX-License-Identifier: Apache-2.0
#include "limber/clip/mesh_sequence_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/clip/sample_meshes.h"
#include "tests/clip/scratch_folder.h"

namespace limber {
namespace {

TEST(MeshSequenceReader, GivesTheMeshOnceAndThePositionsFrameByFrame) {
  const test::ScratchFolder folder;
  const Result<std::unique_ptr<ClipReader>> clip = open_mesh_sequence(
      {{folder.write("1.obj", test::tetrahedron_obj("0")), folder.write("2.obj", test::tetrahedron_obj("0.5"))}, 1});
  ASSERT_DONE(clip);
  ClipReader& reader = **clip;
  EXPECT_EQ(reader.mesh(), test::tetrahedron());
  EXPECT_EQ(reader.frame_count(), 2u);
  EXPECT_EQ(reader.first_frame_number(), 1u);
  for (int pass = 0; pass < 3; ++pass) {
    const auto frames = test::read_all(reader);
    ASSERT_DONE(frames);
    ASSERT_EQ(frames->size(), 2u);
    EXPECT_EQ((*frames)[0][0].x, 0.0f);
    EXPECT_EQ((*frames)[1][0].x, 0.5f);
    ASSERT_DONE(reader.rewind());
  }
}

TEST(MeshSequenceReader, StartsAgainFromTheMiddle) {
  const test::ScratchFolder folder;
  const Result<std::unique_ptr<ClipReader>> clip = open_mesh_sequence(
      {{folder.write("1.obj", test::tetrahedron_obj("0")), folder.write("2.obj", test::tetrahedron_obj("0.5"))}, 1});
  ASSERT_DONE(clip);
  std::vector<Vec3f> positions(4);
  ASSERT_DONE((*clip)->rewind());
  ASSERT_DONE((*clip)->read(positions));
  ASSERT_DONE((*clip)->rewind());
  ASSERT_DONE((*clip)->read(positions));
  EXPECT_EQ(positions[0].x, 0.0f);
}

TEST(MeshSequenceReader, LeavesThePositionsAloneAfterTheLastFrame) {
  const test::ScratchFolder folder;
  const Result<std::unique_ptr<ClipReader>> clip =
      open_mesh_sequence({{folder.write("1.obj", test::tetrahedron_obj())}, 1});
  ASSERT_DONE(clip);
  std::vector<Vec3f> positions(4);
  ASSERT_DONE((*clip)->read(positions));
  positions.assign(4, Vec3f{7, 7, 7});
  const Result<bool> more = (*clip)->read(positions);
  ASSERT_DONE(more);
  EXPECT_FALSE(*more);
  EXPECT_EQ(positions[3], (Vec3f{7, 7, 7}));
}

Result<bool> read_second(const std::string& text) {
  const test::ScratchFolder folder;
  const Result<std::unique_ptr<ClipReader>> clip =
      open_mesh_sequence({{folder.write("1.obj", test::tetrahedron_obj()), folder.write("2.obj", text)}, 1});
  if (!clip) return clip.error();
  std::vector<Vec3f> positions(4);
  if (Result<bool> first = (*clip)->read(positions); !first) return first;
  return (*clip)->read(positions);
}

TEST(MeshSequenceReader, RefusesAFrameWithAnotherNumberOfVertices) {
  EXPECT_ERROR(read_second("v 9 9 9\n" + test::tetrahedron_obj()), kMismatch,
               "2.obj: has 5 vertices and 4 triangles, but the first frame, 1.obj, has 4 and 4");
}

TEST(MeshSequenceReader, RefusesAFrameWithMoreOrFewerTriangles) {
  EXPECT_ERROR(read_second(test::tetrahedron_obj() + "f 1 2 3\n"), kMismatch, "2.obj: has 4 vertices and 5 triangles");
  EXPECT_ERROR(read_second("v 0 0 0\nv 0 0 0\nv 0 0 0\nv 0 0 0\nf 1 3 2\n"), kMismatch, "4 vertices and 1 triangles");
}

TEST(MeshSequenceReader, RefusesAFrameWithOneOtherTriangle) {
  std::string text = test::tetrahedron_obj();
  text.replace(text.find("f 2 3 4"), 7, "f 2 4 3");
  EXPECT_ERROR(read_second(text), kMismatch,
               "2.obj: triangle 2 joins the vertices (1 3 2), but in the first frame, 1.obj, (1 2 3)");
}

TEST(MeshSequenceReader, RefusesALaterFrameThatBreaksARule) {
  EXPECT_ERROR(read_second(test::tetrahedron_obj("nan")), kBadInput, "2.obj:1: the position of vertex 1 is not finite");
  EXPECT_ERROR(read_second(""), kTruncated, "2.obj: the file is empty");
}

TEST(MeshSequenceReader, RefusesALaterFrameThatIsGone) {
  const test::ScratchFolder folder;
  const Result<std::unique_ptr<ClipReader>> clip =
      open_mesh_sequence({{folder.write("1.obj", test::tetrahedron_obj()), folder / "2.obj"}, 1});
  ASSERT_DONE(clip);
  EXPECT_ERROR(test::read_all(**clip), kNotFound, "2.obj: no such file");
}

TEST(MeshSequenceReader, ReadsFramesOfAnotherFormatThanTheFirst) {
  const test::ScratchFolder folder;
  const Result<MeshFile> file = test::parse(test::tetrahedron_obj("0.25"), "a.obj");
  ASSERT_DONE(file);
  ASSERT_DONE(write_mesh(folder / "2.ply", {file->mesh.triangles, file->positions}));
  const Result<std::unique_ptr<ClipReader>> clip =
      open_mesh_sequence({{folder.write("1.obj", test::tetrahedron_obj()), folder / "2.ply"}, 1});
  ASSERT_DONE(clip);
  const auto frames = test::read_all(**clip);
  ASSERT_DONE(frames);
  EXPECT_EQ(frames->back(), file->positions);
}

}  // namespace
}  // namespace limber
