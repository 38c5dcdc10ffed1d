// SPDX-License-Identifier: Apache-2.0
#include "limber/fourface/creases.h"

#include "limber/fourface/face_table.h"

namespace limber {

std::vector<std::array<Index, 2>> find_creases(const Mesh& mesh, std::span<const Vec3f> positions, double cosine) {
  std::vector<std::array<Index, 2>> creases;
  const FaceTable faces(mesh);
  const auto normal = [&](Index f) {
    const auto& [a, b, c] = faces.face(f).corners;
    const auto p = static_cast<Vec3d>(positions[a]);
    return cross(static_cast<Vec3d>(positions[b]) - p, static_cast<Vec3d>(positions[c]) - p);
  };
  for (Index f = 0; f < faces.face_slots(); ++f) {
    for (Index i = 0; i < 3; ++i) {
      const Index h = 4 * f + i, twin = faces.twin(h);
      if (twin == kNone || twin < h) continue;
      const Vec3d a = normal(f), b = normal(FaceTable::face_of(twin));
      if (dot(a, b) < cosine * length(a) * length(b)) creases.push_back({faces.origin(h), faces.target(h)});
    }
  }
  return creases;
}

}  // namespace limber
