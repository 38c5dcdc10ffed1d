// SPDX-License-Identifier: Apache-2.0
// Small meshes, and their positions in a few frames.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "limber/clip/clip.h"
#include "limber/clip/mesh_file.h"

namespace limber::test {

// All that must survive: an isolated vertex (8), a repeated triangle, a degenerate one, an edge of three triangles
// (0 1), a bow-tie (at 2), a second component, and borders.
inline Mesh awkward_mesh() {
  return {12, {{0, 1, 2}, {0, 1, 2}, {1, 0, 3}, {0, 1, 4}, {2, 5, 6}, {7, 7, 5}, {9, 10, 11}}};
}

// Numbers that need all their digits.
inline std::vector<Vec3f> awkward_positions(std::uint32_t vertex_count, std::uint32_t frame) {
  std::vector<Vec3f> positions(vertex_count);
  for (std::uint32_t i = 0; i < vertex_count; ++i) {
    const auto a = static_cast<float>(i + 1);
    const auto b = static_cast<float>(frame + 1);
    positions[i] = {a / 3.0f - b * 1e-7f, -b / 7.0f * 1e20f / a, a * b * 1.1754944e-38f / 5.0f};
  }
  return positions;
}

inline std::string tetrahedron_obj(const std::string& first_x = "0") {
  return "v " + first_x + " 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
}

inline Mesh tetrahedron() { return {4, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}}; }

// Reads the text of a mesh file as if it had this name.
inline Result<MeshFile> parse(std::string_view bytes, const std::string& name) {
  MeshFile file;
  MeshSink sink = MeshSink::collecting(file.positions, file.mesh.triangles);
  if (Result<void> done = read_mesh(bytes, name, sink); !done) return done.error();
  file.mesh.vertex_count = static_cast<Index>(file.positions.size());
  return file;
}

// The remaining frames of a clip, or the error that ended it.
inline Result<std::vector<std::vector<Vec3f>>> read_all(ClipReader& reader) {
  std::vector<std::vector<Vec3f>> frames;
  std::vector<Vec3f> positions(reader.mesh().vertex_count);
  while (true) {
    const Result<bool> more = reader.read(positions);
    if (!more) return more.error();
    if (!*more) return frames;
    frames.push_back(positions);
  }
}

}  // namespace limber::test

// Expects that `result` is an error of this code whose line contains this text.
#define EXPECT_ERROR(result, error_code, text)                                                                  \
  do {                                                                                                          \
    const auto& result_or_error = (result);                                                                     \
    ASSERT_FALSE(result_or_error);                                                                              \
    EXPECT_EQ(result_or_error.error().code, ::limber::ErrorCode::error_code) << result_or_error.error().line(); \
    EXPECT_THAT(result_or_error.error().line(), ::testing::HasSubstr(text));                                    \
    EXPECT_THAT(result_or_error.error().line(), ::testing::Not(::testing::HasSubstr("\n")));                    \
  } while (false)

// Expects success, and says what the error is otherwise.
#define ASSERT_DONE(result)                                     \
  do {                                                          \
    const auto& done_or_error = (result);                       \
    ASSERT_TRUE(done_or_error) << done_or_error.error().line(); \
  } while (false)
