// SPDX-License-Identifier: Apache-2.0
#include "eval/changed.h"

#include <algorithm>

namespace limber::eval {

std::optional<double> ChangedTriangles::add(std::span<const Triangle> ids) {
  now_.assign(ids.begin(), ids.end());
  for (Triangle& triangle : now_) std::sort(triangle.begin(), triangle.end());
  std::sort(now_.begin(), now_.end());

  std::size_t new_count = 0;
  auto old = before_.begin();
  for (const Triangle& triangle : now_) {
    while (old != before_.end() && *old < triangle) ++old;
    if (old == before_.end() || *old != triangle) ++new_count;
  }
  now_.swap(before_);
  if (first_frame_) {
    first_frame_ = false;
    return std::nullopt;
  }
  return ids.empty() ? 0.0 : static_cast<double>(new_count) / static_cast<double>(ids.size());
}

}  // namespace limber::eval
