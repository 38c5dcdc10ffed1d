// SPDX-License-Identifier: Apache-2.0
// What is written to a four-face file comes back.
#include <gtest/gtest.h>

#include "limber/stream/build_four_k_file.h"
#include "limber/stream/error_coding.h"
#include "limber/stream/four_k_clip.h"
#include "limber/stream/four_k_decoder.h"
#include "tests/stream/four_k_files.h"

namespace limber {
namespace {

using test::Shape;

std::vector<Shape> shapes() {
  return {test::waved(test::sheet(20, 20)),
          test::sheet_with_hole(12, 12),
          test::sphere(3),
          test::together(test::sphere(2), test::sheet(5, 5), 4),
          test::quantized(test::jittered(test::sheet(10, 10), 0.4f, 2), 4),
          test::tetrahedron()};
}

TEST(FourKRoundTrip, GivesEveryPrefixOfTheOperationsBack) {
  for (const Shape& shape : shapes()) {
    const auto bytes = test::four_k_file(shape, {.lossless = true});
    FourKDecoder decoder;
    ASSERT_TRUE(decoder.open(bytes));
    EXPECT_TRUE(decoder.is_whole());
    const auto part = decoder.read_part(0);
    ASSERT_TRUE(part) << part.error().line();
    const FourKMesh written = build_four_k(shape.mesh, shape.positions, {});
    const FourKMesh& read = part->mesh;
    ASSERT_EQ(read.operation_count(), written.operation_count());
    EXPECT_EQ(read.level_begin, written.level_begin);
    EXPECT_EQ(validate(read, part->positions), nullptr);
    for (Index o = 0; o <= read.operation_count(); o += 1 + read.operation_count() / 20)
      ASSERT_EQ(test::sorted_triangles(triangles_after(read, o), part->numbers),
                test::sorted_triangles(triangles_after(written, o)));
    for (Index o = 0; o < read.operation_count(); ++o) {
      ASSERT_EQ(part->numbers[read.vertex[o]], written.vertex[o]);
      ASSERT_EQ(read.error[o], error_value(quantized_error(written.error[o])));
      if (!read.is_removal(o)) continue;
      ASSERT_EQ(part->numbers[read.kept(o)], written.kept(o));
    }
    for (Index v = 0; v < read.vertex_count; ++v) ASSERT_EQ(part->positions[v], shape.positions[part->numbers[v]]);
  }
}

TEST(FourKRoundTrip, KeepsPositionsWithinTheTolerance) {
  const Shape shape = test::jittered(test::sphere(4), 0.02f, 3);
  FourKDecoder decoder;
  const auto bytes = test::four_k_file(shape, {.tolerance = 1e-3});
  ASSERT_TRUE(decoder.open(bytes));
  const auto part = decoder.read_part(0);
  ASSERT_TRUE(part);
  for (Index v = 0; v < part->mesh.vertex_count; ++v)
    EXPECT_LE(length(static_cast<Vec3d>(part->positions[v]) - static_cast<Vec3d>(shape.positions[part->numbers[v]])),
              decoder.header().tolerance);
  EXPECT_LT(bytes.size(), 11 * shape.positions.size());
}

TEST(FourKRoundTrip, GivesEveryFrameInAnyOrder) {
  const Shape shape = test::waved(test::sheet(12, 12));
  const auto bytes = test::four_k_file(shape, {.lossless = true, .key_interval = 3, .frame_count = 8});
  FourKClip clip;
  ASSERT_TRUE(clip.open(bytes));
  ASSERT_EQ(clip.decoder().frame_count(), 8u);
  for (const std::uint32_t frame : {0u, 1u, 2u, 7u, 3u, 3u, 0u, 5u, 6u}) {
    ASSERT_TRUE(clip.go_to(frame));
    EXPECT_EQ(clip.frame(), frame);
    for (Index v = 0; v < clip.mesh().vertex_count; ++v) {
      Vec3f expected = shape.positions[clip.numbers()[v]];
      if (frame > 0) expected.z += 0.1f * static_cast<float>(frame % 4) * expected.x;
      ASSERT_EQ(clip.positions()[v], expected) << frame;
    }
    EXPECT_EQ(validate(clip.mesh(), clip.positions()), nullptr);
  }
}

TEST(FourKRoundTrip, RefusesSwapsThatStandApartFromTheirRemoval) {
  const Shape shape = test::sphere(2);
  FourKMesh mesh = build_four_k(shape.mesh, shape.positions, {});
  Index swap = 0;
  while (mesh.is_removal(swap)) ++swap;
  mesh.vertex[swap] = mesh.triangles[mesh.created_begin[swap]][1];
  std::vector<std::byte> bytes;
  FourKEncoder encoder(test::into(bytes));
  ASSERT_TRUE(encoder.begin(bounds(shape.positions), shape.mesh.vertex_count, {}));
  const auto added = encoder.add_part(mesh, shape.positions);
  ASSERT_FALSE(added);
  EXPECT_EQ(added.error().code, ErrorCode::kUnsupported);
}

TEST(FourKRoundTrip, RefusesToEndWithoutAllFrames) {
  const Shape shape = test::sphere(1);
  std::vector<std::byte> bytes;
  FourKEncoder encoder(test::into(bytes));
  ASSERT_TRUE(encoder.begin(bounds(shape.positions), shape.mesh.vertex_count, {.frame_count = 2}));
  ASSERT_TRUE(encoder.add_part(build_four_k(shape.mesh, shape.positions, {}), shape.positions));
  EXPECT_EQ(encoder.finish().error().code, ErrorCode::kMismatch);
}

TEST(FourKRoundTrip, BuildsAFileFromAClip) {
  const auto clip = open_clip("sample:gallop?vertices=300&frames=5", {});
  ASSERT_TRUE(clip);
  std::vector<std::byte> bytes;
  const auto report = build_four_k_file(**clip, {}, test::into(bytes));
  ASSERT_TRUE(report) << report.error().line();
  EXPECT_EQ(report->frame_count, 5u);
  EXPECT_EQ(report->file_bytes, bytes.size());
  FourKClip read;
  ASSERT_TRUE(read.open(bytes));
  EXPECT_EQ(read.mesh().finest_count, report->finest_count);
  EXPECT_EQ(read.decoder().frame_count(), 5u);
  ASSERT_TRUE((*clip)->rewind());
  std::vector<Vec3f> positions((*clip)->mesh().vertex_count);
  for (std::uint32_t frame = 0; frame < 5; ++frame) {
    ASSERT_TRUE((*clip)->read(positions));
    ASSERT_TRUE(read.go_to(frame));
    for (Index v = 0; v < read.mesh().vertex_count; ++v)
      ASSERT_LE(length(static_cast<Vec3d>(read.positions()[v]) - static_cast<Vec3d>(positions[read.numbers()[v]])),
                read.decoder().header().tolerance);
  }
}

TEST(FourKRoundTrip, StopsWhenItIsAskedTo) {
  const auto clip = open_clip("sample:gallop?vertices=300&frames=2", {});
  std::vector<std::byte> bytes;
  const auto report = build_four_k_file(**clip, {}, test::into(bytes),
                                        [](const BuildProgress& p) { return p.stage != BuildStage::kFrames; });
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().code, ErrorCode::kCancelled);
}

}  // namespace
}  // namespace limber
