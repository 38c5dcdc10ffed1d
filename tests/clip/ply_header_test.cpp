// SPDX-License-Identifier: Apache-2.0
#include "limber/clip/ply_header.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/clip/sample_meshes.h"

namespace limber {
namespace {

const std::string kVertex = "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
const std::string kFace = "element face 1\nproperty list uchar int vertex_indices\n";

TEST(PlyHeader, GivesElementsPropertiesAndTheStartOfTheBody) {
  const std::string text = "ply\ncomment before\nformat binary_big_endian 1.0\nobj_info x\n" + kVertex +
                           "property uchar red\n" + kFace + "end_header\nBODY";
  const Result<PlyHeader> header = read_ply_header(text, "a.ply");
  ASSERT_DONE(header);
  EXPECT_EQ(header->encoding, PlyEncoding::kBigEndian);
  ASSERT_EQ(header->elements.size(), 2u);
  EXPECT_EQ(header->elements[0].name, "vertex");
  EXPECT_EQ(header->elements[0].properties.size(), 4u);
  EXPECT_EQ(header->elements[0].properties[3].role, PlyRole::kIgnored);
  EXPECT_EQ(header->elements[1].properties[0].count_type, PlyType::kUint8);
  EXPECT_EQ(header->elements[1].properties[0].role, PlyRole::kCorners);
  EXPECT_EQ(header->vertex_count, 3u);
  EXPECT_EQ(text.substr(header->body_offset), "BODY");
  EXPECT_EQ(header->body_line, 13u);
}

TEST(PlyHeader, FindsABodyThatStartsWithALineEnd) {
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    std::string text = "ply\nformat binary_little_endian 1.0\n" + kVertex + kFace + "end_header\n";
    for (std::size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at + end.size())) {
      text.replace(at, 1, end);
    }
    const std::string body = end == "\r" ? "\nBODY" : "\r\nBODY";
    text += body;
    const Result<PlyHeader> header = read_ply_header(text, "a.ply");
    ASSERT_DONE(header);
    EXPECT_EQ(text.substr(header->body_offset), body);
  }
}

TEST(PlyHeader, RefusesWhatIsNotPly) {
  const auto header = [](const std::string& text) { return read_ply_header(text, "a.ply"); };
  EXPECT_ERROR(header("OFF\n"), kBadInput, "a.ply:1: a PLY file must start with the word ply");
  EXPECT_ERROR(header("ply\nformat xml 1.0\n"), kBadInput, "a.ply:2: a PLY header must go on with `format`");
  EXPECT_ERROR(header("ply\nformat ascii 1.0\nbanana\n"), kBadInput, "a.ply:3: the header has a line that starts with");
  EXPECT_ERROR(header("ply\nformat ascii 1.0\nproperty float x\n"), kBadInput, "a.ply:3: a property must stand behind");
  EXPECT_ERROR(header("ply\nformat ascii 1.0\nelement vertex\n"), kBadInput, "a.ply:3: an element needs");
  EXPECT_ERROR(header("ply\nformat ascii 1.0\nelement vertex -3\n"), kBadInput, "an element needs");
  EXPECT_ERROR(header("ply\nformat ascii 1.0\nelement a 1\nelement a 1\n"), kBadInput,
               "a.ply:4: an element of this name");
  EXPECT_ERROR(header("ply\nformat ascii 1.0\nelement vertex 1\nproperty half x\n"), kBadInput, "a property needs");
  EXPECT_ERROR(header("ply\nformat ascii 1.0\nelement vertex 1\nproperty list int x\n"), kBadInput, "a property needs");
}

TEST(PlyHeader, RefusesAHeaderThatDoesNotEnd) {
  EXPECT_ERROR(read_ply_header("ply\nformat ascii 1.0\n" + kVertex, "a.ply"), kTruncated, "ends inside its header");
}

TEST(PlyHeader, RefusesAFileWithoutVerticesOrFaces) {
  EXPECT_ERROR(read_ply_header("ply\nformat ascii 1.0\n" + kFace + "end_header\n", "a.ply"), kBadInput,
               "no element `vertex`");
  EXPECT_ERROR(read_ply_header("ply\nformat ascii 1.0\n" + kVertex + "end_header\n", "a.ply"), kBadInput,
               "has no faces");
  EXPECT_ERROR(read_ply_header("ply\nformat ascii 1.0\n" + kVertex +
                                   "element tristrips 1\nproperty list int int vertex_indices\nend_header\n",
                               "a.ply"),
               kUnsupported, "triangle strips are not read");
}

}  // namespace
}  // namespace limber
