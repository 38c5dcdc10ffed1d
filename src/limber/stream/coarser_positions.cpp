// SPDX-License-Identifier: Apache-2.0
#include "limber/stream/coarser_positions.h"

namespace limber {

CoarserPositions::CoarserPositions(std::span<const Index> level_begin, bool turning)
    : level_begin_(level_begin),
      turning_(turning),
      turns_(level_begin),
      now_(level_begin.back() - level_begin[1]),
      children_(now_.size()),
      nodes_(now_.size()) {}

}  // namespace limber
