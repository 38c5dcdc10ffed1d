// SPDX-License-Identifier: Apache-2.0
// How the distances to an approximation are distributed over the surface and the frames (Kircher & Garland, Fig. 7).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace limber::eval {

// Takes any number of distances in a bounded memory: each is kept to 1.1 %.
class ErrorDistribution {
 public:
  // Precondition: finite and >= 0.
  void add(double distance);

  std::uint64_t size() const { return size_; }

  // The distance that a share of all, 0 to 1, does not exceed; 0 where there are none.
  double percentile(double share) const;

  // The shares of distances in `count` equal steps from 0 to `high`, and, last, beyond it: [count + 1]. Precondition:
  // high > 0.
  std::vector<double> shares(double high, std::size_t count) const;

 private:
  std::vector<std::uint64_t> counts_;  // by the logarithm of the distance
  std::uint64_t size_ = 0;
};

}  // namespace limber::eval
