// SPDX-License-Identifier: Apache-2.0
// Counts what the test program allocates.
#pragma once

#include <cstddef>

namespace limber::test {

// The number of calls of operator new since the program started.
std::size_t allocation_count();

}  // namespace limber::test
