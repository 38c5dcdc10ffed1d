// SPDX-License-Identifier: Apache-2.0
// The largest single allocation of this test program, so that tests can show that no reader trusts a length.
#pragma once

#include <cstddef>

namespace limber::test {

void reset_largest_allocation();
std::size_t largest_allocation();

}  // namespace limber::test
