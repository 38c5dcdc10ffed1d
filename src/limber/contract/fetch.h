// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace limber {

// Asks for the memory at `address`, which need not be valid, to be on its way into the cache. The empty statement keeps
// GCC from taking a function that does nothing else for one without effect, and dropping its calls.
inline void fetch(const void* address) {
  __builtin_prefetch(address);
  asm volatile("");
}

}  // namespace limber
