// SPDX-License-Identifier: Apache-2.0
// The worked example of docs/format.md, byte for byte: lines of the form "0012  89 4c ...  what it is".
#include <cctype>
#include <fstream>
#include <gtest/gtest.h>
#include <sstream>

#include "tests/stream/sample_clip.h"

namespace limber::test {
namespace {

// Two triangles; vertices 0 and 1 in node 4, 2 and 3 in node 5; in frame 1 all move by a tenth and vertex 2 goes over.
SampleClip example_clip() {
  SampleClip clip{{4, {{0, 1, 2}, {2, 1, 3}}}, {}};
  Hierarchy hierarchy{{0, 4, 6}, {4, 4, 5, 5, kNone, kNone}};
  clip.frames.push_back({hierarchy,
                         {},
                         {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0.5f, 0, 0}, {0.5f, 1, 0}},
                         {0, 0, 0, 0, 0.25f, 0.25f}});
  clip.frames.push_back({hierarchy, {{2, 4}}, clip.frames[0].positions, {0, 0, 0, 0, 0.5f, 0}});
  SampleFrame& second = clip.frames[1];
  for (const Swap& swap : second.swaps) apply(second.hierarchy, swap);
  second.positions[4] = {0.375f, 0.375f, 0};
  second.positions[5] = {1, 1, 0};
  for (Vec3f& p : second.positions) p.x += 0.125f;
  return clip;
}

std::vector<std::byte> documented_bytes(const std::string& path) {
  std::ifstream file(path);
  EXPECT_TRUE(file) << path;
  std::vector<std::byte> bytes;
  std::string line;
  bool inside = false;
  while (std::getline(file, line)) {
    if (line.rfind("```", 0) == 0) inside = line == "```example";
    if (!inside || line.size() < 6 || !std::isxdigit(static_cast<unsigned char>(line[0]))) continue;
    EXPECT_EQ(std::stoul(line.substr(0, 4), nullptr, 16), bytes.size()) << line;
    for (std::size_t at = 6; at + 1 < line.size() && std::isxdigit(static_cast<unsigned char>(line[at])); at += 3)
      bytes.push_back(static_cast<std::byte>(std::stoul(line.substr(at, 2), nullptr, 16)));
  }
  return bytes;
}

std::string hex(std::span<const std::byte> bytes) {
  std::ostringstream out;
  out << std::hex;
  for (std::size_t i = 0; i < bytes.size(); ++i)
    out << (i % 16 ? " " : "\n") << (std::to_integer<unsigned>(bytes[i]) < 16 ? "0" : "")
        << std::to_integer<unsigned>(bytes[i]);
  return out.str();
}

TEST(FormatExample, HasTheBytesThatTheDocumentExplains) {
  const auto bytes = encode(example_clip(), {.tolerance = 0.01, .key_interval = 8, .frame_count = 2});
  EXPECT_EQ(hex(bytes), hex(documented_bytes(LIMBER_SOURCE_DIR "/docs/format.md")));
}

}  // namespace
}  // namespace limber::test
