// SPDX-License-Identifier: Apache-2.0
#include "limber/stream/coding_state.h"

namespace limber {

CodingState::CodingState(const Mesh& mesh, std::span<const Index> level_begin, bool lossless)
    : CodingState(mesh, level_begin, lossless, incident_triangles(mesh)) {}

void CodingState::reset_models() {
  finest_statistics.reset();
  coarser_statistics.reset();
  hierarchy_models = {};
  errors.key_statistics.reset();
  errors.step_statistics.reset();
}

CodingState::CodingState(const Mesh& mesh, std::span<const Index> level_begin, bool lossless,
                         const IndexLists& incident)
    : neighbors(limber::neighbors(mesh, incident)),
      traversal(traverse(mesh, incident, neighbors)),
      clusters(level_begin, neighbors),
      finest(traversal),
      coarser(level_begin, !lossless),
      errors(level_begin.back() - level_begin[1]),
      order(level_begin.back()) {}

}  // namespace limber
