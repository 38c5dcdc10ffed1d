// SPDX-License-Identifier: Apache-2.0
// The 4-K mesh (Velho 2001; a multi-triangulation, De Floriani, Magillo & Puppo 1997): a graph of local operations that
// make a mesh coarser, and, each reversed, finer. Every set of operations that holds all those that its members depend
// on gives a mesh.
//
//   swap           two triangles for two
//   removal        two triangles for the four around a vertex; one for three; one for the two at a border vertex
//
// Every triangle that there ever is has a number; it is created by one operation, unless it is one of the finest, and
// destroyed by one, unless it is one of the coarsest. So the triangles are the arcs of the graph: an operation depends
// on those that have created what it destroys.
#pragma once

#include <span>
#include <vector>

#include "limber/base/mesh.h"
#include "limber/base/vec.h"

namespace limber {

struct FourKMesh {
  Index vertex_count = 0;           // of the input; corners are vertices of the input
  Index finest_count = 0;           // triangles 0 .. finest_count are the input's, without degenerate ones
  std::vector<Triangle> triangles;  // [triangle_count]: the finest, then in the order of the operations
  std::vector<Index> creator;       // [triangle_count]: an operation; kNone for the finest
  std::vector<Index> destroyer;     // [triangle_count]: an operation; kNone for the coarsest

  // The operations, in an order in which they can be applied to the finest mesh.
  std::vector<Index> created_begin;    // [operation_count + 1], of triangles
  std::vector<Index> destroyed_begin;  // [operation_count + 1], of destroyed
  std::vector<Index> destroyed;        // triangles
  std::vector<Index> vertex;           // [operation_count]: what it removes, or a swap helps to remove
  std::vector<float> error;            // [operation_count]: a distance, >= that of all operations that it depends on
  std::vector<float> radius;           // [operation_count]: a sphere around the vertex's finest position that holds the
                                       // triangles destroyed and the spheres of what the operation depends on

  std::vector<Index> level_begin;  // [level_count + 1], of operations: the passes of the simplification

  Index operation_count() const { return static_cast<Index>(vertex.size()); }
  Index triangle_count() const { return static_cast<Index>(triangles.size()); }
  Index level_count() const { return level_begin.empty() ? 0 : static_cast<Index>(level_begin.size() - 1); }
  std::span<const Index> destroyed_by(Index operation) const {
    return {destroyed.data() + destroyed_begin[operation], destroyed_begin[operation + 1] - destroyed_begin[operation]};
  }
  // The neighbour that stands for the vertex from then on. Precondition: is_removal(operation).
  Index kept(Index operation) const { return triangles[created_begin[operation]][0]; }
  Index created_count(Index operation) const { return created_begin[operation + 1] - created_begin[operation]; }
  bool is_removal(Index operation) const { return created_count(operation) < destroyed_by(operation).size(); }
  std::size_t byte_count() const;
};

struct FourKHeight {
  Index operations = 0;  // on the longest chain of operations that depend on each other
  Index clusters = 0;    // on the longest chain, where the swaps for a vertex and its removal count as one
};
FourKHeight height(const FourKMesh& mesh);

// The triangles after the first `operation_count` operations.
std::vector<Triangle> triangles_after(const FourKMesh& mesh, Index operation_count);

// The least number of operations after which at most so many vertices have triangles, or at most so many triangles are
// left; all operations where these do not suffice.
Index operations_to_vertices(const FourKMesh& mesh, Index vertices);
Index operations_to_triangles(const FourKMesh& mesh, Index triangles);

// The name of the first invariant that does not hold, found from scratch; nullptr where all do (docs/design.md,
// "Four-face clusters").
const char* validate(const FourKMesh& mesh, std::span<const Vec3f> positions);

}  // namespace limber
