// SPDX-License-Identifier: Apache-2.0
#include "limber/clip/obj.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/clip/sample_meshes.h"
#include "tests/clip/scratch_folder.h"

namespace limber {
namespace {

using test::parse;

const std::string kVertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\n";

std::vector<Triangle> triangles_of(const std::string& faces) {
  const Result<MeshFile> file = parse(kVertices + faces, "a.obj");
  EXPECT_TRUE(file) << file.error().line();
  return file ? file->mesh.triangles : std::vector<Triangle>{};
}

TEST(ObjReader, ReadsCornersInAllFourForms) {
  const std::vector<Triangle> expected{{0, 1, 2}};
  EXPECT_EQ(triangles_of("f 1 2 3"), expected);
  EXPECT_EQ(triangles_of("f 1/7 2/8 3/9"), expected);
  EXPECT_EQ(triangles_of("f 1//7 2//8 3//9\n"), expected);
  EXPECT_EQ(triangles_of("f 1/4/7 2/5/8 3/6/9 \t\r\n"), expected);
}

TEST(ObjReader, CountsNegativeIndicesBackFromTheLastVertexSoFar) {
  EXPECT_EQ(triangles_of("f -5 -4/-1 -3//-1\nv 9 9 9\nf -1 -2 -6"), (std::vector<Triangle>{{0, 1, 2}, {5, 4, 0}}));
}

TEST(ObjReader, CutsAPolygonIntoAFan) {
  EXPECT_EQ(triangles_of("f 1 2 3 4 5"), (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}));
}

TEST(ObjReader, JoinsContinuedLines) {
  EXPECT_EQ(triangles_of("f 1 \\\n 2 \\\r\n3\nf 1 3 4"), (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
}

TEST(ObjReader, IgnoresEverythingThatIsNeitherVertexNorFace) {
  const Result<MeshFile> file = parse(
      "\xEF\xBB\xBF# comment \\\nmtllib a b.mtl\no thing\nv 0 0 0 1\nv 1 0 0 0.5 0.5 0.5 # colour\nv 0 1 0\nvt 0 0\nvn "
      "0 "
      "0 1\nvp 1\ng x\ns off\nusemtl #1\nl 1 2\np 1\nf 1 2 3 # face\nfoo bar\n",
      "a.obj");
  ASSERT_DONE(file);
  EXPECT_EQ(file->mesh, (Mesh{3, {{0, 1, 2}}}));
  EXPECT_EQ(file->positions, (std::vector<Vec3f>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
}

TEST(ObjReader, ReadsTheLineEndsOfAllSystems) {
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    const Result<MeshFile> file = parse("v 0 0 0" + end + "v 1 0 0" + end + "v 0 1 0" + end + "f 1 2 3", "a.obj");
    ASSERT_DONE(file);
    EXPECT_EQ(file->mesh, (Mesh{3, {{0, 1, 2}}}));
  }
}

TEST(ObjReader, AcceptsAFaceBeforeItsVertices) {
  const Result<MeshFile> file = parse("f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n", "a.obj");
  ASSERT_DONE(file);
  EXPECT_EQ(file->mesh, (Mesh{3, {{0, 1, 2}}}));
}

TEST(ObjReader, RefusesAFaceThatNamesAVertexBeyondTheLast) {
  EXPECT_ERROR(parse(kVertices + "f 1 2 3\nf 1 2 6\nf 1 2 3\n", "a.obj"), kBadInput,
               "a.obj:7: the face names vertex 6, but the file has 5 vertices");
}

TEST(ObjReader, RefusesVertexZeroAndNegativeIndicesBeforeTheFirstVertex) {
  EXPECT_ERROR(parse(kVertices + "f 0 1 2\n", "a.obj"), kBadInput, "a.obj:6: the face names vertex 0");
  EXPECT_ERROR(parse(kVertices + "f -6 1 2\n", "a.obj"), kBadInput, "a.obj:6: the face names vertex -6");
  EXPECT_ERROR(parse(kVertices + "f 1 2 9999999999\n", "a.obj"), kBadInput, "9999999999");
  EXPECT_ERROR(parse(kVertices + "f 1 2 99999999999999999999\n", "a.obj"), kBadInput, "a corner of a face must be");
}

TEST(ObjReader, RefusesTextWhereANumberShouldBe) {
  EXPECT_ERROR(parse("v 0 0\n", "a.obj"), kBadInput, "a.obj:1: a vertex needs three numbers");
  EXPECT_ERROR(parse("v 0 0 0\nv 1,5 0 0\n", "a.obj"), kBadInput, "a.obj:2: a vertex needs three numbers");
  EXPECT_ERROR(parse(kVertices + "f a b c\n", "a.obj"), kBadInput, "a.obj:6: a corner of a face must be");
  EXPECT_ERROR(parse(kVertices + "f 1.5 2 3\n", "a.obj"), kBadInput, "a.obj:6: a corner of a face must be");
  EXPECT_ERROR(parse(kVertices + "f 1 2\n", "a.obj"), kBadInput, "a.obj:6: a face needs three corners");
}

TEST(ObjReader, RefusesAPositionThatIsNotFinite) {
  for (const std::string number : {"nan", "inf", "-inf", "1e39"}) {
    EXPECT_ERROR(parse("v 0 0 0\nv 0 " + number + " 0\n", "a.obj"), kBadInput,
                 "a.obj:2: the position of vertex 2 is not finite");
  }
}

TEST(ObjWriter, WritesNormalsPerVertex) {
  const test::ScratchFolder folder;
  const std::vector<Triangle> triangles{{0, 1, 2}};
  const std::vector<Vec3f> positions{{0, 0, 0}, {1, 0, 0}, {0, 0.1f, 0}};
  const std::vector<Vec3f> normals(3, Vec3f{0, 0, 1});
  ASSERT_DONE(write_mesh(folder / "a.obj", {triangles, positions, normals}));
  EXPECT_EQ(folder.read("a.obj"), "v 0 0 0\nv 1 0 0\nv 0 0.1 0\nvn 0 0 1\nvn 0 0 1\nvn 0 0 1\nf 1//1 2//2 3//3\n");
}

}  // namespace
}  // namespace limber
