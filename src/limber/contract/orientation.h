// SPDX-License-Identifier: Apache-2.0
// Triangles that face the same way.
#pragma once

#include "limber/base/mesh.h"

namespace limber {

// Turns triangles over so that every two that share an edge with no third pass it in opposite directions, where the
// surface can be oriented. Of the triangles that are joined through such edges the first keeps its direction; on a
// surface with only one side some edges stay as they are not meant to be.
void orient_alike(Mesh& mesh);

}  // namespace limber
