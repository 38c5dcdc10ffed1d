// SPDX-License-Identifier: Apache-2.0
// A hierarchy over a shape with its quadrics.
#pragma once

#include <algorithm>

#include "limber/contract/vertex_quadrics.h"
#include "limber/hierarchy/clustering.h"
#include "tests/support/hierarchies.h"

namespace limber::test {

inline Clustering weighed(const Shape& shape, double branching, Topology topology = Topology::kPreserve) {
  Clustering c(built(shape, branching, topology));
  const Normalization to = normalization(shape.positions);
  for (Index v = 0; v < shape.mesh.vertex_count; ++v) c.finest_positions()[v] = to.to_unit(shape.positions[v]);
  VertexQuadrics of_vertices(shape.mesh, {});
  of_vertices.compute(c.finest_positions(), c.finest_quadrics());
  std::ranges::copy(of_vertices.facings(), c.finest_facings().begin());
  c.weigh();
  return c;
}

}  // namespace limber::test
