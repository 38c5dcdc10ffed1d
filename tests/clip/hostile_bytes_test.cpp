// SPDX-License-Identifier: Apache-2.0
// Files cut at every length and with each byte changed: an error or a mesh that keeps its invariant, never a crash,
// a hang, or an allocation that the bytes do not justify.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "limber/clip/clip.h"
#include "tests/clip/allocation_meter.h"
#include "tests/clip/point_caches.h"
#include "tests/clip/sample_meshes.h"
#include "tests/clip/scratch_folder.h"

namespace limber {
namespace {

// Room for streams, messages and small vectors, beside what is in proportion to the bytes.
constexpr std::size_t kFixedMemory = 1 << 16;
constexpr std::size_t kMemoryPerByte = 16;

void expect_error_or_whole_mesh(const std::string& bytes, const std::string& name) {
  test::reset_largest_allocation();
  const Result<MeshFile> file = test::parse(bytes, name);
  EXPECT_LE(test::largest_allocation(), kFixedMemory + kMemoryPerByte * bytes.size());
  if (!file) {
    EXPECT_THAT(file.error().line(), testing::StartsWith(name));
    return;
  }
  ASSERT_EQ(file->positions.size(), file->mesh.vertex_count);
  ASSERT_FALSE(file->mesh.triangles.empty());
  for (const Vec3f& position : file->positions) ASSERT_TRUE(is_finite(position));
  for (const Triangle& triangle : file->mesh.triangles) {
    for (const Index corner : triangle) ASSERT_LT(corner, file->mesh.vertex_count);
  }
}

// A small file of each format and encoding, by name.
std::vector<std::pair<std::string, std::string>> sample_files() {
  const test::ScratchFolder folder;
  const Mesh mesh = test::awkward_mesh();
  const std::vector<Vec3f> positions = test::awkward_positions(mesh.vertex_count, 0);
  std::vector<std::pair<std::string, std::string>> files;
  for (const std::string name : {"a.obj", "a.off", "a.ply", "b.ply"}) {
    EXPECT_TRUE(write_mesh(folder / name, {mesh.triangles, positions}, {.text = name == "b.ply"}));
    files.emplace_back(name, folder.read(name));
  }
  std::string big = files[2].second;
  big.replace(big.find("little"), 6, "big");
  files.emplace_back("c.ply", big);
  return files;
}

TEST(HostileBytes, MeshFilesCutAtEveryLength) {
  for (const auto& [name, bytes] : sample_files()) {
    for (std::size_t size = 0; size < bytes.size(); ++size) expect_error_or_whole_mesh(bytes.substr(0, size), name);
  }
}

TEST(HostileBytes, MeshFilesWithEachByteChanged) {
  for (const auto& [name, bytes] : sample_files()) {
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      for (const char change : {'\x01', '\x10', '\x80', '\xff'}) {
        std::string changed = bytes;
        changed[i] = static_cast<char>(changed[i] ^ change);
        expect_error_or_whole_mesh(changed, name);
      }
      for (const char byte : {'9', '-', '\n', '\r', '\\', '#', '\0'}) {
        std::string changed = bytes;
        changed[i] = byte;
        expect_error_or_whole_mesh(changed, name);
      }
    }
  }
}

TEST(HostileBytes, BinaryPlyIsTruncatedAtEveryLengthOfItsBody) {
  const auto files = sample_files();
  const std::string& bytes = files[2].second;
  for (std::size_t size = bytes.find("end_header") + 11; size < bytes.size(); ++size) {
    EXPECT_ERROR(test::parse(bytes.substr(0, size), "a.ply"), kTruncated, "a.ply, byte");
  }
}

TEST(HostileBytes, CountsThatNoFileHolds) {
  for (const std::string count : {"4294967295", "4294967296", "9223372036854775807", "99999999999999999999", "-1"}) {
    const std::string zeros(4000, '0');
    for (const std::string encoding : {"ascii", "binary_little_endian", "binary_big_endian"}) {
      const std::string start = "ply\nformat " + encoding + " 1.0\nelement vertex ";
      const std::string vertex = "\nproperty float x\nproperty float y\nproperty float z\nelement face ";
      const std::string face = "\nproperty list uint uint vertex_indices\nend_header\n";
      expect_error_or_whole_mesh(start + count + vertex + "1" + face + zeros, "a.ply");
      expect_error_or_whole_mesh(start + "3" + vertex + count + face + zeros, "a.ply");
      expect_error_or_whole_mesh(start + "3" + vertex + "1" + face + std::string(36, '\0') + "\xff\xff\xff\xff" + zeros,
                                 "a.ply");
    }
    expect_error_or_whole_mesh("OFF\n" + count + " 1 0\n" + zeros, "a.off");
    expect_error_or_whole_mesh("OFF\n1 " + count + " 0\n0 0 0\n" + zeros, "a.off");
    expect_error_or_whole_mesh("OFF\n1 1 0\n0 0 0\n" + count + " 0 0 0\n" + zeros, "a.off");
  }
}

void expect_error_or_frames(const test::ScratchFolder& folder, const std::string& name, const std::string& bytes) {
  const std::string path = folder.write(name, bytes);
  test::reset_largest_allocation();
  const auto clip = open_clip(path, {});
  if (clip) {
    std::vector<Vec3f> positions((*clip)->mesh().vertex_count);
    for (Result<bool> more = (*clip)->read(positions); more && *more; more = (*clip)->read(positions)) {
      for (const Vec3f& position : positions) ASSERT_TRUE(is_finite(position));
    }
  }
  EXPECT_LE(test::largest_allocation(), kFixedMemory + kMemoryPerByte * bytes.size());
}

TEST(HostileBytes, PointCachesCutAtEveryLengthAndWithEachByteChanged) {
  const test::ScratchFolder folder;
  folder.write("a.obj", test::tetrahedron_obj());
  const std::vector<std::pair<std::string, std::string>> files{
      {"a.pc2", test::pc2_header(4, 3) + test::four_points<std::endian::little>(3)},
      {"a.mdd", test::mdd_header(4, {0, 1, 2}) + test::four_points<std::endian::big>(3)}};
  for (const auto& [name, bytes] : files) {
    for (std::size_t size = 0; size < bytes.size(); ++size) {
      EXPECT_ERROR(open_clip(folder.write(name, bytes.substr(0, size)), {}), kTruncated, name);
    }
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      for (const char change : {'\x01', '\x80', '\x7f', '\xff'}) {
        std::string changed = bytes;
        changed[i] = static_cast<char>(changed[i] ^ change);
        expect_error_or_frames(folder, name, changed);
      }
    }
  }
}

}  // namespace
}  // namespace limber
