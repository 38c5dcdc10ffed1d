// SPDX-License-Identifier: Apache-2.0
#include "limber/clip/ply.h"

#include <bit>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "limber/clip/byte_order.h"
#include "tests/clip/sample_meshes.h"
#include "tests/clip/scratch_folder.h"

namespace limber {
namespace {

using test::parse;

const std::string kTextHeader =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
const std::string kTextVertices = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";

template <std::endian kOrder, class T>
void put(std::string& bytes, T value) {
  char buffer[sizeof(T)];
  if constexpr (std::is_same_v<T, double>) {
    store<std::uint64_t, kOrder>(std::bit_cast<std::uint64_t>(value), buffer);
  } else if constexpr (std::is_same_v<T, float>) {
    store_float<kOrder>(value, buffer);
  } else {
    store<std::make_unsigned_t<T>, kOrder>(static_cast<std::make_unsigned_t<T>>(value), buffer);
  }
  bytes.append(buffer, sizeof(T));
}

// A quad among properties and elements of every type, in an unusual order: faces before vertices.
template <std::endian kOrder>
std::string file_of_all_types() {
  std::string bytes = "ply\nformat ";
  bytes += kOrder == std::endian::little ? "binary_little_endian" : "binary_big_endian";
  bytes +=
      " 1.0\nelement empty 4000000000\nelement junk 2\nproperty char a\nproperty list ushort double b\n"
      "element face 1\nproperty short flags\nproperty list uint ushort vertex_index\nproperty list int float texture\n"
      "element vertex 4\nproperty uchar red\nproperty double z\nproperty list uchar uint bones\nproperty short x\n"
      "property float y\nend_header\n";
  for (int row = 0; row < 2; ++row) {
    put<kOrder>(bytes, std::int8_t{-1});
    put<kOrder>(bytes, std::uint16_t{2});
    put<kOrder>(bytes, 1.0);
    put<kOrder>(bytes, 2.0);
  }
  put<kOrder>(bytes, std::int16_t{7});
  put<kOrder>(bytes, std::uint32_t{4});
  for (std::uint16_t i = 0; i < 4; ++i) put<kOrder>(bytes, i);
  put<kOrder>(bytes, std::int32_t{1});
  put<kOrder>(bytes, 0.5f);
  for (std::int16_t i = 0; i < 4; ++i) {
    put<kOrder>(bytes, std::uint8_t{255});
    put<kOrder>(bytes, 0.25 * i);
    put<kOrder>(bytes, std::uint8_t{1});
    put<kOrder>(bytes, std::uint32_t{9});
    put<kOrder>(bytes, static_cast<std::int16_t>(-i));
    put<kOrder>(bytes, 1.5f);
  }
  return bytes;
}

TEST(PlyReader, ReadsAllTypesInAnyOrderOfBytesPropertiesAndElements) {
  for (const std::string& bytes : {file_of_all_types<std::endian::little>(), file_of_all_types<std::endian::big>()}) {
    const Result<MeshFile> file = parse(bytes, "a.ply");
    ASSERT_DONE(file);
    EXPECT_EQ(file->mesh, (Mesh{4, {{0, 1, 2}, {0, 2, 3}}}));
    EXPECT_EQ(file->positions, (std::vector<Vec3f>{{0, 1.5f, 0}, {-1, 1.5f, .25f}, {-2, 1.5f, .5f}, {-3, 1.5f, .75f}}));
  }
}

TEST(PlyReader, ReadsTextWhereverItsLinesEnd) {
  for (const std::string body : {"0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n", "0 0 0 1 0 0 1 1 0 0 1 0 4 0 1 2 3"}) {
    const Result<MeshFile> file = parse(kTextHeader + body, "a.ply");
    ASSERT_DONE(file);
    EXPECT_EQ(file->mesh, (Mesh{4, {{0, 1, 2}, {0, 2, 3}}}));
    EXPECT_EQ(file->positions[2], (Vec3f{1, 1, 0}));
  }
}

TEST(PlyReader, RefusesAFaceThatNamesAVertexBeyondTheLast) {
  EXPECT_ERROR(parse(kTextHeader + kTextVertices + "3 0 1 4\n", "a.ply"), kBadInput,
               "a.ply:14: face 0 names vertex 4, but there are 4, numbered from 0");
  EXPECT_ERROR(parse(kTextHeader + kTextVertices + "3 0 1 -1\n", "a.ply"), kBadInput, "face 0 names vertex -1");
}

TEST(PlyReader, RefusesAVertexNumberThatIsNotWhole) {
  std::string header = kTextHeader;
  header.replace(header.find("uchar int"), 9, "uchar float");
  EXPECT_ERROR(parse(header + kTextVertices + "3 0 1 1.5\n", "a.ply"), kBadInput, "face 0 names vertex 1.5");
}

TEST(PlyReader, RefusesAListOfANegativeOrUnknownNumberOfValues) {
  std::string header = kTextHeader;
  header.replace(header.find("uchar int"), 9, "float int");
  EXPECT_ERROR(parse(header + kTextVertices + "-3 0 1 2\n", "a.ply"), kBadInput, "face 0 has a list of -3 values");
  EXPECT_ERROR(parse(header + kTextVertices + "nan 0 1 2\n", "a.ply"), kBadInput, "face 0 has a list of nan values");
}

TEST(PlyReader, RefusesAPositionThatIsNotFinite) {
  EXPECT_ERROR(parse(kTextHeader + "0 0 0\n1 0 0\ninf 1 0\n0 1 0\n3 0 1 2\n", "a.ply"), kBadInput,
               "a.ply:12: the position of vertex 2 is not finite");
  std::string header = kTextHeader;
  header.replace(header.find("ascii"), 5, "binary_little_endian");
  EXPECT_ERROR(parse(header + std::string(48, '\xff') + "xxxxx", "a.ply"), kBadInput,
               ", byte 181: the position of vertex 0 is not finite");
}

TEST(PlyReader, RefusesTextThatIsNoNumber) {
  EXPECT_ERROR(parse(kTextHeader + "0 0 0\n1 0 x\n1 1 0\n0 1 0\n3 0 1 2\n", "a.ply"), kBadInput,
               "a.ply:11: vertex 1 has something else than the number");
}

TEST(PlyReader, RefusesAFileThatEndsEarly) {
  EXPECT_ERROR(parse(kTextHeader + "0 0 0\n1 0 0\n", "a.ply"), kTruncated, "too short for 4 rows of element vertex");
  EXPECT_ERROR(parse(kTextHeader + kTextVertices + "3 0 1", "a.ply"), kTruncated, "the file ends in face 0 of 1");
  std::string header = kTextHeader;
  header.replace(header.find("ascii"), 5, "binary_little_endian");
  header.replace(header.find("vertex 4"), 8, "vertex 9223372036854775807");
  EXPECT_ERROR(parse(header + std::string(48, '\0'), "a.ply"), kTruncated, "too short for 9223372036854775807 rows");
}

TEST(PlyWriter, WritesBinaryFilesThatStartWithTheirHeader) {
  const test::ScratchFolder folder;
  const std::vector<Triangle> triangles{{0, 1, 2}};
  const std::vector<Vec3f> positions{{0, 0, 0}, {1, 0, 0}, {0, 0.1f, 0}};
  const std::vector<Vec3f> normals(3, Vec3f{0, 0, 1});
  ASSERT_DONE(write_mesh(folder / "a.ply", {triangles, positions, normals}));
  const std::string bytes = folder.read("a.ply");
  const std::string header =
      "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "property float nx\nproperty float ny\nproperty float nz\nelement face 1\n"
      "property list uchar uint vertex_indices\nend_header\n";
  EXPECT_EQ(bytes.substr(0, header.size()), header);
  EXPECT_EQ(bytes.size(), header.size() + 3 * 24 + 13);
}

TEST(PlyWriter, WritesTextOnRequest) {
  const test::ScratchFolder folder;
  const std::vector<Triangle> triangles{{0, 1, 2}};
  const std::vector<Vec3f> positions{{0, 0, 0}, {1, 0, 0}, {0, 0.1f, 0}};
  ASSERT_DONE(write_mesh(folder / "a.ply", {triangles, positions}, {.text = true}));
  EXPECT_THAT(folder.read("a.ply"), testing::EndsWith("end_header\n0 0 0\n1 0 0\n0 0.1 0\n3 0 1 2\n"));
}

}  // namespace
}  // namespace limber
