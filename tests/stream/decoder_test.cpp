// SPDX-License-Identifier: Apache-2.0
// Streams that are damaged, hostile, or still arriving.
#include "limber/stream/decoder.h"

#include <gtest/gtest.h>

#include "limber/stream/chunk.h"
#include "tests/stream/sample_clip.h"

namespace limber::test {
namespace {

constexpr std::size_t kHeaderAt = kPreambleSize;

std::size_t payload_of(std::size_t chunk) { return chunk + kChunkHeaderSize; }

std::size_t next_chunk(std::span<const std::byte> bytes, std::size_t chunk) {
  return payload_of(chunk) + load_little_endian<std::uint32_t>(&bytes[chunk + 8]);
}

void put(std::vector<std::byte>& bytes, std::size_t at, std::uint32_t value) {
  for (std::size_t i = 0; i < 4; ++i) bytes[at + i] = static_cast<std::byte>(value >> (8 * i));
}

// Makes the checksums of a chunk right again.
void seal(std::vector<std::byte>& bytes, std::size_t chunk) {
  const std::size_t end = next_chunk(bytes, chunk);
  put(bytes, chunk + 12, crc32c(std::span(bytes).subspan(payload_of(chunk), end - payload_of(chunk))));
  put(bytes, chunk + 16, crc32c(std::span(bytes).subspan(chunk, 16)));
}

// What opening and playing gives: the first error, or nothing.
std::string first_error(std::span<const std::byte> bytes) {
  Decoder decoder;
  const auto opened = decoder.open(bytes);
  if (!opened) return opened.error().line();
  std::string error;
  play(decoder, &error);
  return error;
}

ErrorCode open_code(std::span<const std::byte> bytes) {
  Decoder decoder;
  const auto opened = decoder.open(bytes);
  EXPECT_FALSE(opened);
  return opened ? ErrorCode::kIo : opened.error().code;
}

TEST(Decoder, FindsEveryFlippedByte) {
  const auto bytes = encode(rough_clip(5), {.key_interval = 3, .frame_count = 5});
  ASSERT_EQ(first_error(bytes), "");
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    for (const unsigned flip : {0x01u, 0x80u}) {
      auto damaged = bytes;
      damaged[i] ^= static_cast<std::byte>(flip);
      EXPECT_NE(first_error(damaged), "") << "byte " << i;
    }
  }
}

TEST(Decoder, GivesAllWholeFramesOfAStreamCutAnywhere) {
  const auto bytes = encode(rough_clip(5), {.key_interval = 3});
  Decoder whole;
  ASSERT_TRUE(whole.open(bytes));
  const auto expected = play(whole);
  std::vector<std::size_t> ends;  // of the frames
  std::size_t end = next_chunk(bytes, kHeaderAt);
  const std::size_t mesh_end = end = next_chunk(bytes, end);
  for (int f = 0; f < 5; ++f) ends.push_back(end = next_chunk(bytes, end));
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    const std::vector<std::byte> cut(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length));
    Decoder decoder;
    const auto opened = decoder.open(cut);
    ASSERT_EQ(static_cast<bool>(opened), length >= mesh_end) << length;
    if (!opened) {
      EXPECT_EQ(opened.error().code, ErrorCode::kTruncated);
      continue;
    }
    const auto states = play(decoder);
    const auto there = std::count_if(ends.begin(), ends.end(), [length](std::size_t e) { return e <= length; });
    ASSERT_EQ(states.size(), static_cast<std::size_t>(there)) << length;
    for (std::size_t f = 0; f < states.size(); ++f) EXPECT_TRUE(same_state(states[f], expected[f]));
  }
}

TEST(Decoder, GivesTheSameFramesWhileTheStreamArrivesByteByByte) {
  const auto bytes = encode(rough_clip(6), {.key_interval = 4});
  Decoder whole;
  ASSERT_TRUE(whole.open(bytes));
  const auto expected = play(whole);
  Decoder decoder;
  FrameState state;
  bool opened = false;
  std::uint32_t next = 0;
  std::vector<std::byte> kept;
  for (std::size_t length = 1; length <= bytes.size(); ++length) {
    std::vector<std::byte> arrived(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length));
    if (!opened) {
      opened = static_cast<bool>(decoder.open(arrived));
      if (opened) decoder.prepare(state);
    } else {
      ASSERT_TRUE(decoder.extend(arrived));
    }
    kept = std::move(arrived);
    for (; opened && next < decoder.available_frames(); ++next) {
      ASSERT_TRUE(decoder.decode(next, state));
      EXPECT_TRUE(same_state(state, expected[next]));
    }
  }
  EXPECT_EQ(next, 6u);
  EXPECT_EQ(decoder.frame_count(), 6u);
}

TEST(Decoder, MayBeExtendedBetweenHierarchyAndPositions) {
  const auto bytes = encode(rough_clip(2), {});
  Decoder whole;
  ASSERT_TRUE(whole.open(bytes));
  const auto expected = play(whole);
  const std::vector<std::byte> part(bytes.begin(), bytes.end() - 10);
  Decoder decoder;
  ASSERT_TRUE(decoder.open(part));
  FrameState state;
  decoder.prepare(state);
  ASSERT_TRUE(decoder.decode_hierarchy(0, state));
  ASSERT_TRUE(decoder.extend(bytes));
  ASSERT_TRUE(decoder.decode_positions(0, state));
  EXPECT_TRUE(same_state(state, expected[0]));
}

TEST(Decoder, StaysAsItWasWhenTheExtensionIsDamaged) {
  const auto bytes = encode(rough_clip(3), {});
  auto damaged = bytes;
  damaged.back() ^= std::byte{1};
  Decoder decoder;
  ASSERT_TRUE(decoder.open(std::span(bytes).first(bytes.size() - 20)));
  EXPECT_FALSE(decoder.extend(damaged));
  EXPECT_EQ(play(decoder).size(), 3u);
  EXPECT_TRUE(decoder.extend(bytes));
}

TEST(Decoder, KnowsTheNumberOfFramesFromTheHeaderOrTheIndex) {
  const auto announced = encode(rough_clip(3), {.frame_count = 3}), silent = encode(rough_clip(3), {});
  Decoder decoder;
  ASSERT_TRUE(decoder.open(std::span(announced).first(announced.size() - 1)));
  EXPECT_EQ(decoder.frame_count(), 3u);
  ASSERT_TRUE(decoder.open(silent));
  EXPECT_EQ(decoder.frame_count(), 3u);
  const std::size_t index_size = kChunkHeaderSize + 8 + 3 * 8 + 4;
  ASSERT_TRUE(decoder.open(std::span(silent).first(silent.size() - kEndMarkSize - index_size)));
  EXPECT_EQ(decoder.available_frames(), 3u);
  EXPECT_EQ(decoder.frame_count(), std::nullopt);
}

TEST(Decoder, AccountsForEveryByteOfAFrame) {
  const auto bytes = encode(rough_clip(2), {});
  Decoder decoder;
  ASSERT_TRUE(decoder.open(bytes));
  std::size_t at = next_chunk(bytes, next_chunk(bytes, kHeaderAt));
  for (std::uint32_t f = 0; f < 2; ++f) {
    EXPECT_EQ(decoder.sizes(f).total(), next_chunk(bytes, at) - at);
    at = next_chunk(bytes, at);
  }
}

TEST(Decoder, SkipsOptionalChunksThatItDoesNotKnow) {
  const auto bytes = encode(rough_clip(2), {});
  std::vector<std::byte> extra;
  append_little_endian(extra, chunk_kind('b', 'n', 'd', 's'));
  append_little_endian(extra, 0u);
  append_little_endian(extra, 3u);
  extra.resize(20 + 3, std::byte{0x55});
  seal(extra, 0);
  // Before the mesh, and between the frames; the index is left out, as its offsets would be wrong.
  const std::size_t mesh = next_chunk(bytes, kHeaderAt), first = next_chunk(bytes, mesh),
                    second = next_chunk(bytes, first);
  std::vector<std::byte> longer(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(next_chunk(bytes, second)));
  for (const std::size_t at : {second, first, mesh})
    longer.insert(longer.begin() + static_cast<std::ptrdiff_t>(at), extra.begin(), extra.end());
  Decoder decoder;
  const auto opened = decoder.open(longer);
  ASSERT_TRUE(opened) << opened.error().line();
  EXPECT_EQ(play(decoder).size(), 2u);
}

TEST(Decoder, RefusesChunksThatItNeedsButDoesNotKnow) {
  auto bytes = encode(rough_clip(2), {});
  const std::size_t first = next_chunk(bytes, next_chunk(bytes, kHeaderAt));
  put(bytes, first, chunk_kind('F', 'U', 'T', 'R'));
  seal(bytes, first);
  bytes.pop_back();  // without a whole index the chunks are looked through
  EXPECT_EQ(open_code(bytes), ErrorCode::kUnsupported);
}

TEST(Decoder, RefusesOtherFilesAndVersions) {
  auto bytes = encode(rough_clip(1), {});
  for (const std::uint32_t version : {1u, 3u}) {
    put(bytes, 8, version);
    EXPECT_EQ(open_code(bytes), ErrorCode::kUnsupported);
  }
  bytes[0] = std::byte{'o'};
  EXPECT_EQ(open_code(bytes), ErrorCode::kBadInput);
  EXPECT_EQ(open_code(std::span(bytes).first(1)), ErrorCode::kBadInput);
  EXPECT_EQ(open_code({}), ErrorCode::kTruncated);
}

// Offsets of fields in the payload of the header chunk, and values that may not be there.
TEST(Decoder, RefusesHeadersOutsideTheLimits) {
  struct Case {
    std::size_t field;
    std::uint32_t value;
  };
  const auto bytes = encode(rough_clip(1), {});
  for (const auto& [field, value] :
       {Case{0, 0x80}, Case{12, 0}, Case{20, 0x7ff00000}, Case{28, 0x7ff80000}, Case{52, 0x80000001},
        Case{52, 0x7fe00000}, Case{72, 0xffffffff}, Case{72, 1000000}, Case{76, 0}, Case{76, 4}, Case{76, 0xffffffff},
        Case{80, 0}, Case{80, 0xffffffff}, Case{84, 3}, Case{88, 0x10000000}}) {
    auto hostile = bytes;
    put(hostile, payload_of(kHeaderAt) + field, value);
    seal(hostile, kHeaderAt);
    Decoder decoder;
    const auto opened = decoder.open(hostile);
    EXPECT_FALSE(opened) << field << ' ' << value;
  }
}

TEST(Decoder, RefusesAnIndexThatPointsElsewhere) {
  const auto bytes = encode(rough_clip(3), {.key_interval = 2});
  const auto index = static_cast<std::size_t>(load_little_endian<std::uint64_t>(&bytes[bytes.size() - kEndMarkSize]));
  for (std::size_t field = 0; field < 8 + 3 * 8 + 2 * 4; field += 4) {
    for (const std::uint32_t change : {1u, 0x40u, 0x80000000u}) {
      auto hostile = bytes;
      put(hostile, payload_of(index) + field,
          load_little_endian<std::uint32_t>(&hostile[payload_of(index) + field]) ^ change);
      seal(hostile, index);
      EXPECT_NE(first_error(hostile), "") << field << ' ' << change;
    }
  }
}

// With checksums made right again anything may come out, but within memory and as finite numbers.
TEST(Decoder, SurvivesWrongSectionsWithRightChecksums) {
  for (const bool lossless : {false, true}) {
    const auto bytes = encode(rough_clip(2), {.lossless = lossless, .key_interval = 2});
    std::size_t chunk = next_chunk(bytes, kHeaderAt);
    while (load_little_endian<std::uint32_t>(&bytes[chunk]) != kIndexChunk) {
      for (std::size_t at = payload_of(chunk); at < next_chunk(bytes, chunk); ++at) {
        for (const unsigned flip : {0x01u, 0xffu}) {
          auto hostile = bytes;
          hostile[at] ^= static_cast<std::byte>(flip);
          seal(hostile, chunk);
          Decoder decoder;
          if (!decoder.open(hostile)) continue;
          for (const FrameState& state : play(decoder))
            for (const Vec3f& p : state.positions) ASSERT_TRUE(is_finite(p));
        }
      }
      chunk = next_chunk(bytes, chunk);
    }
  }
}

TEST(Decoder, GoesOnFromAKeyAfterADamagedFrame) {
  auto bytes = encode(rough_clip(4), {.key_interval = 2});
  const std::size_t second = next_chunk(bytes, next_chunk(bytes, next_chunk(bytes, kHeaderAt)));
  bytes[payload_of(second) + 20] ^= std::byte{1};
  Decoder decoder;
  ASSERT_TRUE(decoder.open(bytes));
  FrameState state;
  decoder.prepare(state);
  ASSERT_TRUE(decoder.decode(0, state));
  const auto damaged = decoder.decode(1, state);
  ASSERT_FALSE(damaged);
  EXPECT_EQ(damaged.error().where, "frame 1, byte " + std::to_string(second));
  EXPECT_TRUE(decoder.decode(2, state));
  EXPECT_TRUE(decoder.decode(3, state));
}

}  // namespace
}  // namespace limber::test
