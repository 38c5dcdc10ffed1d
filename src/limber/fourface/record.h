// SPDX-License-Identifier: Apache-2.0
// A simplification, written down operation by operation as a 4-K mesh.
#pragma once

#include <span>

#include "limber/base/mesh.h"
#include "limber/base/vec.h"
#include "limber/fourface/face_table.h"
#include "limber/fourface/four_k_mesh.h"

namespace limber {

class Record {
 public:
  // Of the mesh from which `faces` was made, with which it shares the numbers of triangles.
  Record(const Mesh& mesh, const FaceTable& faces);

  // One more operation: the triangles destroyed, and the faces that are there in their place, which get the numbers of
  // new triangles, this depth, at most Face::kMostDepth, and one more than the most operations below. `error`: its own.
  void add(FaceTable& faces, Index v, double error, std::span<const Index> destroyed,
           std::span<const Index> created_faces, unsigned depth, unsigned operations = 0);
  // The first triangle created by the last operation begins with u from now on.
  void begin_with(Index u);
  // A level ends. False: it was empty, and is none.
  bool end_level();

  Index finest_count() const { return mesh_.finest_count; }
  Index operation_count() const { return mesh_.operation_count(); }
  Index level_count() const { return mesh_.level_count(); }

  // Without radii, and with the operations' own errors: see make_monotone().
  FourKMesh take() && { return std::move(mesh_); }

 private:
  FourKMesh mesh_;
};

// Gives operations spheres that hold those of what they depend on, and errors, divided by `scale` before, that are
// at least theirs. positions: [mesh.vertex_count].
void make_monotone(FourKMesh& mesh, std::span<const Vec3f> positions, double scale);

}  // namespace limber
