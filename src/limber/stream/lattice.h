// SPDX-License-Identifier: Apache-2.0
// The lattice on which stored positions lie.
#pragma once

#include "limber/base/vec.h"

namespace limber {

struct LatticeChoice {
  Vec3d origin;
  double step = 0;  // 0: there is none, positions have to be stored losslessly
};

// Step and origin so that lattice points are floats: step is a small number times a power of two, origin a multiple of
// that power, and floats of up to eight times the size met in `box` are finer than it. Then the distance to the nearest
// lattice point, at most `tolerance`, is all of the error.
LatticeChoice choose_lattice(double tolerance, const Box& box);

}  // namespace limber
