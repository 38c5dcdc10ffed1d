// SPDX-License-Identifier: Apache-2.0
// Four-face files that are damaged, hostile, or still arriving.
#include "limber/stream/four_k_decoder.h"

#include <gtest/gtest.h>

#include "limber/fourface/front.h"
#include "limber/stream/four_k_clip.h"
#include "tests/stream/four_k_files.h"

namespace limber {
namespace {

// The first error of opening it and going through its frames, or nothing.
std::string first_error(std::span<const std::byte> bytes) {
  FourKClip clip;
  if (const auto opened = clip.open(bytes); !opened) return opened.error().line();
  for (std::uint32_t frame = 0; frame < clip.decoder().frame_count(); ++frame)
    if (const auto gone = clip.go_to(frame); !gone) return gone.error().line();
  return clip.decoder().is_whole() ? "" : "not whole";
}

std::vector<std::byte> small_file() {
  return test::four_k_file(test::waved(test::sheet(7, 6)), {.key_interval = 2, .frame_count = 4});
}

void put(std::vector<std::byte>& bytes, std::size_t at, std::uint32_t value) {
  for (std::size_t i = 0; i < 4; ++i) bytes[at + i] = static_cast<std::byte>(value >> (8 * i));
}

// Makes all checksums right again.
void seal(std::vector<std::byte>& bytes) {
  for (std::size_t at = kPreambleSize; bytes.size() - at >= kChunkHeaderSize;) {
    const std::size_t length = load_little_endian<std::uint32_t>(&bytes[at + 8]);
    if (length > bytes.size() - at - kChunkHeaderSize) return;
    put(bytes, at + 12, crc32c(std::span(bytes).subspan(at + kChunkHeaderSize, length)));
    put(bytes, at + 16, crc32c(std::span(bytes).subspan(at, 16)));
    at += kChunkHeaderSize + length;
  }
}

TEST(FourKDecoder, TellsItsFilesFromOthers) {
  const auto bytes = small_file();
  EXPECT_TRUE(is_four_face_file(bytes));
  EXPECT_FALSE(is_four_face_file(std::span(bytes).first(12)));
  auto other = bytes;
  put(other, kPreambleSize, kHeaderChunk);
  EXPECT_FALSE(is_four_face_file(other));
}

TEST(FourKDecoder, FindsEveryFlippedByte) {
  const auto bytes = small_file();
  ASSERT_EQ(first_error(bytes), "");
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    for (const unsigned flip : {0x01u, 0x80u}) {
      auto damaged = bytes;
      damaged[i] ^= static_cast<std::byte>(flip);
      EXPECT_NE(first_error(damaged), "") << "byte " << i;
    }
  }
}

TEST(FourKDecoder, SurvivesEveryFlippedByteUnderTheRightChecksum) {
  const auto bytes = small_file();
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    auto damaged = bytes;
    damaged[i] ^= static_cast<std::byte>(1 << (i % 8));
    seal(damaged);
    FourKDecoder decoder;
    if (!decoder.open(damaged)) continue;
    const auto part = decoder.read_part(0);
    if (!part) continue;
    // Whatever came out, fronts of it can move.
    Front front(part->mesh);
    front.move([](Index) { return false; });
    EXPECT_EQ(front.triangles().size(), part->mesh.finest_count);
  }
}

TEST(FourKDecoder, ReadsAFileCutAnywhereAsFarAsItGoes) {
  const test::Shape shape = test::jittered(test::sphere(5), 0.02f, 3);
  const auto bytes = test::four_k_file(shape);
  FourKDecoder whole;
  ASSERT_TRUE(whole.open(bytes));
  const auto all = whole.read_part(0);
  ASSERT_TRUE(all);
  Index before = 0;
  for (std::size_t length = 0; length < bytes.size(); length += length < 400 ? 1 : 997) {
    FourKDecoder decoder;
    const auto opened = decoder.open(std::span(bytes).first(length));
    if (!opened) {
      EXPECT_EQ(opened.error().code, ErrorCode::kTruncated) << length;
      EXPECT_EQ(before, 0u) << length;
      continue;
    }
    EXPECT_FALSE(decoder.is_whole());
    const auto part = decoder.read_part(0);
    ASSERT_TRUE(part) << length << part.error().line();
    ASSERT_GE(part->mesh.operation_count(), before);
    if (part->mesh.operation_count() == before) continue;
    before = part->mesh.operation_count();
    EXPECT_EQ(validate(part->mesh, part->positions), nullptr);
    // What is there is the same from the coarse end.
    const Index missing = all->mesh.operation_count() - before;
    EXPECT_EQ(test::sorted_triangles(triangles_after(part->mesh, 0)),
              test::sorted_triangles(triangles_after(all->mesh, missing)));
  }
  EXPECT_GT(before, 0u);
}

TEST(FourKDecoder, RefusesASmallFileThatAnnouncesAHugeMesh) {
  auto bytes = small_file();
  const std::size_t part = kPreambleSize + kChunkHeaderSize + 76;
  ASSERT_EQ(load_little_endian<std::uint32_t>(&bytes[part]), kPartChunk);
  put(bytes, part + kChunkHeaderSize, 1u << 27);
  seal(bytes);
  EXPECT_NE(first_error(bytes).find("too short for the coarsest mesh"), std::string::npos);
}

TEST(FourKDecoder, RefusesANewerVersionAndUnknownChunks) {
  auto bytes = small_file();
  bytes[8] = std::byte{9};
  FourKDecoder decoder;
  EXPECT_EQ(decoder.open(bytes).error().code, ErrorCode::kUnsupported);
  bytes = small_file();
  const std::size_t part = kPreambleSize + kChunkHeaderSize + 76;
  put(bytes, part, chunk_kind('N', 'E', 'W', 'S'));
  seal(bytes);
  EXPECT_EQ(decoder.open(bytes).error().code, ErrorCode::kUnsupported);
}

}  // namespace
}  // namespace limber
