// SPDX-License-Identifier: Apache-2.0
// The readers of mesh files: the first byte chooses the format, the rest is the file. Every result must keep
// `corner-in-range`; a second reading, compared with the first, must agree.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "limber/clip/mesh_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace limber;
  if (size == 0) return 0;
  constexpr const char* kNames[] = {"a.obj", "a.ply", "a.off"};
  const std::filesystem::path name = kNames[data[0] % 3];
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  MeshFile file;
  MeshSink sink = MeshSink::collecting(file.positions, file.mesh.triangles);
  if (!read_mesh(bytes, name, sink)) return 0;
  for (const Triangle& triangle : file.mesh.triangles) {
    for (const Index corner : triangle) {
      if (corner >= file.positions.size()) std::abort();
    }
  }
  for (const Vec3f& position : file.positions) {
    if (!is_finite(position)) std::abort();
  }
  std::vector<Vec3f> positions;
  MeshSink again = MeshSink::comparing(positions, file.mesh.triangles);
  if (!read_mesh(bytes, name, again) || again.difference() || positions != file.positions) std::abort();
  return 0;
}
