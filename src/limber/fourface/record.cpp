// SPDX-License-Identifier: Apache-2.0
#include "limber/fourface/record.h"

#include <algorithm>
#include <cmath>

#include "limber/contract/fetch.h"

namespace limber {

Record::Record(const Mesh& mesh, const FaceTable& faces) {
  mesh_.vertex_count = mesh.vertex_count;
  mesh_.finest_count = faces.face_count();
  const std::size_t most = 5 * std::size_t{mesh_.finest_count};
  mesh_.triangles.reserve(most);
  mesh_.creator.reserve(most);
  mesh_.destroyer.reserve(most);
  mesh_.destroyed.reserve(most);
  for (std::vector<Index>* of_operations : {&mesh_.created_begin, &mesh_.destroyed_begin, &mesh_.vertex})
    of_operations->reserve(most / 2);
  mesh_.error.reserve(most / 2);
  for (const Triangle& t : mesh.triangles)
    if (!is_degenerate(t)) mesh_.triangles.push_back(t);
  mesh_.creator.assign(mesh_.finest_count, kNone);
  mesh_.destroyer.assign(mesh_.finest_count, kNone);
  mesh_.created_begin.push_back(mesh_.finest_count);
  mesh_.destroyed_begin.push_back(0);
  mesh_.level_begin.push_back(0);
}

void Record::add(FaceTable& faces, Index v, double error, std::span<const Index> destroyed,
                 std::span<const Index> created_faces, unsigned depth, unsigned operations) {
  const Index operation = mesh_.operation_count();
  for (const Index t : destroyed) mesh_.destroyer[t] = operation;
  mesh_.destroyed.insert(mesh_.destroyed.end(), destroyed.begin(), destroyed.end());
  for (const Index f : created_faces) {
    Face& face = faces.face(f);
    face.triangle = mesh_.triangle_count();
    face.depth = depth & Face::kMostDepth;
    face.operations = static_cast<std::uint16_t>(operations);
    mesh_.triangles.push_back(face.corners);
    mesh_.creator.push_back(operation);
    mesh_.destroyer.push_back(kNone);
  }
  mesh_.created_begin.push_back(mesh_.triangle_count());
  mesh_.destroyed_begin.push_back(static_cast<Index>(mesh_.destroyed.size()));
  mesh_.vertex.push_back(v);
  mesh_.error.push_back(static_cast<float>(error));
}

void Record::begin_with(Index u) {
  Triangle& created = mesh_.triangles[mesh_.created_begin[mesh_.operation_count() - 1]];
  std::rotate(created.begin(), std::find(created.begin(), created.end(), u), created.end());
}

bool Record::end_level() {
  if (mesh_.operation_count() == mesh_.level_begin.back()) return false;
  mesh_.level_begin.push_back(mesh_.operation_count());
  return true;
}

namespace {

// What the operation some way on destroys, and what that depends on, lies anywhere before it.
void fetch_ahead(const FourKMesh& mesh, Index operation) {
  constexpr Index kFar = 16, kNear = 8;
  if (operation + kFar < mesh.operation_count())
    for (const Index t : mesh.destroyed_by(operation + kFar)) fetch(&mesh.creator[t]), fetch(&mesh.triangles[t]);
  if (operation + kNear >= mesh.operation_count()) return;
  for (const Index t : mesh.destroyed_by(operation + kNear))
    if (const Index c = mesh.creator[t]; c != kNone)
      fetch(&mesh.error[c]), fetch(&mesh.radius[c]), fetch(&mesh.vertex[c]);
}

}  // namespace

void make_monotone(FourKMesh& mesh, std::span<const Vec3f> positions, double scale) {
  // More than what rounding does to distances between spheres.
  constexpr double kMargin = 1 + 1e-5;
  mesh.radius.resize(mesh.operation_count());
  for (Index o = 0; o < mesh.operation_count(); ++o) {
    fetch_ahead(mesh, o);
    const auto center = static_cast<Vec3d>(positions[mesh.vertex[o]]);
    float error = static_cast<float>(mesh.error[o] / scale);
    double radius = 0, farthest = 0;
    for (const Index t : mesh.destroyed_by(o)) {
      const Index c = mesh.creator[t];
      if (c == kNone) {
        for (const Index corner : mesh.triangles[t])
          farthest = std::max(farthest, squared_length(static_cast<Vec3d>(positions[corner]) - center));
        continue;
      }
      // The sphere of what has created a triangle holds the triangle.
      error = std::max(error, mesh.error[c]);
      const double apart = length(static_cast<Vec3d>(positions[mesh.vertex[c]]) - center);
      radius = std::max(radius, apart + static_cast<double>(mesh.radius[c]));
    }
    mesh.error[o] = error;
    mesh.radius[o] = static_cast<float>(std::max(radius, std::sqrt(farthest)) * kMargin);
  }
}

}  // namespace limber
