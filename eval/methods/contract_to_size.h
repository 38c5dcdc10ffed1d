// SPDX-License-Identifier: Apache-2.0
// Contraction to the size that the methods are asked for.
#pragma once

#include "eval/methods/method.h"

namespace limber::eval {

// Contracts to at most options.vertices, or to at most options.triangles; or as near as the topology allows.
void contract_to_size(Contraction& contraction, const Mesh& mesh, const MethodOptions& options);

}  // namespace limber::eval
