// SPDX-License-Identifier: Apache-2.0
// Every invariant of a hierarchy, recomputed from scratch.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "limber/contract/contract.h"
#include "limber/hierarchy/hierarchy.h"
#include "limber/hierarchy/level_graph.h"

namespace limber {

// The first invariant found broken (their names stand beside Hierarchy), and where.
struct Violation {
  std::string_view invariant;
  Index level = 0;
  Index node = kNone;  // kNone where it is the level as a whole

  // "cluster-connected is broken at level 2, node 9481"
  std::string line() const;
};

// Checks hierarchies over one mesh; keeps what it knows of the mesh, and its memory, between calls.
class Validator {
 public:
  // With Topology::kPreserve, `manifold-kept` is checked too: a node that holds only vertices with a regular star has a
  // regular star itself, and every manifold component has the Euler characteristic and the number of border loops that
  // it has on the finest level, which together mean that it is homeomorphic. Of a component that is not manifold no
  // more than the first is promised. The mesh must outlive the validator.
  Validator(const Mesh& mesh, Topology topology);

  std::optional<Violation> operator()(const Hierarchy& hierarchy);

 private:
  // What tells surfaces apart, for each connected component.
  struct Shape {
    long euler_characteristic = 0;
    long border_loop_count = 0;
    friend bool operator==(const Shape&, const Shape&) = default;
  };

  std::optional<Violation> check_tree(const Hierarchy& hierarchy) const;
  std::optional<Violation> check_connection(const Hierarchy& hierarchy, Index level);
  std::optional<Violation> check_shape(const Hierarchy& hierarchy, Index level);
  std::vector<Shape> shapes(const LevelGraph& graph, const std::vector<Index>& component_of_node) const;
  Index find(Index i);

  const Mesh& mesh_;
  Topology topology_;
  std::vector<std::array<Index, 2>> edges_;  // of the finest level
  std::vector<Index> component_;             // [vertex_count]: of the mesh, numbered from 0
  Index component_count_ = 0;
  LevelGraphBuilder builder_;
  LevelGraph finest_;
  LevelGraph image_;
  std::vector<Shape> finest_shapes_;        // [component_count_]
  std::vector<unsigned char> is_manifold_;  // [component_count_]
  std::vector<Index> ancestor_;             // [vertex_count]: on the level at work
  std::vector<Index> union_;                // [vertex_count]: union-find
};

}  // namespace limber
