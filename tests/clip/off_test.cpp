// SPDX-License-Identifier: Apache-2.0
#include "limber/clip/off.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/clip/sample_meshes.h"
#include "tests/clip/scratch_folder.h"

namespace limber {
namespace {

using test::parse;

const Mesh kQuad{4, {{0, 1, 2}, {0, 2, 3}}};
const std::string kRows = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n";

TEST(OffReader, ReadsCountsOnTheLineOfTheHeaderOrTheNext) {
  for (const std::string header :
       {"OFF\n4 1 0\n", "OFF 4 1 0\n", "OFF\n\n# counts\n4 1 0 # edges\n", "OFF\r\n4 1\r\n"}) {
    const Result<MeshFile> file = parse(header + kRows, "a.off");
    ASSERT_DONE(file);
    EXPECT_EQ(file->mesh, kQuad);
    EXPECT_EQ(file->positions[2], (Vec3f{1, 1, 0}));
  }
}

TEST(OffReader, IgnoresNormalsColoursAndTexture) {
  for (const std::string header : {"OFF", "COFF", "NOFF", "CNOFF", "STOFF", "STCNOFF"}) {
    const Result<MeshFile> file = parse(
        header + "\n4 1 0\n0 0 0 255 0 0\n1 0 0 1 1 1\n\n# between\n1 1 0 .1 .2 .3\n0 1 0 4\n4 0 1 2 3 0.5 0.5 0.5\n",
        "a.off");
    ASSERT_DONE(file);
    EXPECT_EQ(file->mesh, kQuad);
  }
}

TEST(OffReader, SkipsFacesOfOneOrTwoCorners) {
  const Result<MeshFile> file = parse("OFF\n3 3 0\n0 0 0\n1 0 0\n0 1 0\n1 0\n2 0 1\n3 0 1 2\n", "a.off");
  ASSERT_DONE(file);
  EXPECT_EQ(file->mesh, (Mesh{3, {{0, 1, 2}}}));
}

TEST(OffReader, RefusesOtherKindsOfOffByName) {
  EXPECT_ERROR(parse("4OFF\n4 1 0\n", "a.off"), kUnsupported, "a.off:1: 4OFF files are not read");
  EXPECT_ERROR(parse("nOFF\n4\n4 1 0\n", "a.off"), kUnsupported, "nOFF");
  EXPECT_ERROR(parse("OFF BINARY\n\x01\x02", "a.off"), kUnsupported, "binary OFF files are not read");
  EXPECT_ERROR(parse("ply\n", "a.off"), kBadInput, "must start with the word OFF");
}

TEST(OffReader, RefusesAHeaderWithoutCounts) {
  EXPECT_ERROR(parse("OFF\nx y z\n", "a.off"), kBadInput, "a.off:2: the header must give");
  EXPECT_ERROR(parse("OFF\n-1 1 0\n", "a.off"), kBadInput, "the header must give");
  EXPECT_ERROR(parse("OFF\n4 1 x\n", "a.off"), kBadInput, "the header must give");
}

TEST(OffReader, RefusesAFileThatEndsEarly) {
  EXPECT_ERROR(parse("OFF\n1000000 1 0\n" + kRows, "a.off"), kTruncated, "too short for the 1000000 vertices");
  EXPECT_ERROR(parse("OFF\n9223372036854775807 9223372036854775807 0\n" + kRows, "a.off"), kTruncated, "too short");
  EXPECT_ERROR(parse("OFF\n4 2 0\n" + kRows, "a.off"), kTruncated, "the file ends after 1 of 2 faces");
  EXPECT_ERROR(parse("OFF\n4 1 0\n0.00000000000000000 0 0\n1 0 0\n", "a.off"), kTruncated,
               "the file ends after 2 of 4 vertices");
  EXPECT_ERROR(parse("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1", "a.off"), kTruncated, "face 0 needs a line of 3");
}

TEST(OffReader, RefusesAFaceThatNamesAVertexBeyondTheLast) {
  EXPECT_ERROR(parse("OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 4\n", "a.off"), kBadInput,
               "a.off:7: face 0 names vertex 4, but vertices are numbered from 0 to 3");
  EXPECT_ERROR(parse("OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 -1\n", "a.off"), kBadInput, "vertex -1");
}

TEST(OffReader, RefusesRowsThatAreTooShortOrNoNumbers) {
  EXPECT_ERROR(parse("OFF\n4 1 0\n0 0\n" + kRows, "a.off"), kBadInput, "a.off:3: vertex 0 needs");
  EXPECT_ERROR(parse("OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n5 0 1 2 3\n", "a.off"), kBadInput, "face 0 needs");
  EXPECT_ERROR(parse("OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n-3 0 1 2\n", "a.off"), kBadInput,
               "number of its corners");
}

TEST(OffReader, RefusesAPositionThatIsNotFinite) {
  EXPECT_ERROR(parse("OFF\n4 1 0\n0 0 0\nnan 0 0\n1 1 0\n0 1 0\n3 0 1 2\n", "a.off"), kBadInput,
               "a.off:4: the position of vertex 1 is not finite");
}

TEST(OffWriter, WritesNormalsBehindThePositions) {
  const test::ScratchFolder folder;
  const std::vector<Triangle> triangles{{0, 1, 2}};
  const std::vector<Vec3f> positions{{0, 0, 0}, {1, 0, 0}, {0, 0.1f, 0}};
  const std::vector<Vec3f> normals(3, Vec3f{0, 0, 1});
  ASSERT_DONE(write_mesh(folder / "a.off", {triangles, positions, normals}));
  EXPECT_EQ(folder.read("a.off"), "NOFF\n3 1 0\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 0.1 0 0 0 1\n3 0 1 2\n");
}

}  // namespace
}  // namespace limber
