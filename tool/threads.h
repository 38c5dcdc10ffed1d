// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace limber::tool {

// The processors that this process may use: what its affinity and the CPU quota of its cgroup allow; >= 1.
unsigned allowed_threads();

}  // namespace limber::tool
