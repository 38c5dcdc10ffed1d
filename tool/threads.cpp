// SPDX-License-Identifier: Apache-2.0
#include "tool/threads.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sched.h>
#include <string>
#include <thread>

namespace limber::tool {
namespace {

unsigned threads_of_affinity() {
  cpu_set_t set;
  CPU_ZERO(&set);
  if (sched_getaffinity(0, sizeof set, &set) == 0) return static_cast<unsigned>(CPU_COUNT(&set));
  return std::thread::hardware_concurrency();  // more processors than the set has room for
}

unsigned whole_processors(double quota, double period) {
  return period > 0 ? static_cast<unsigned>(std::clamp(std::ceil(quota / period), 1.0, 4096.0)) : 4096;
}

// cgroup version 2: "max 100000" or "150000 100000" in each group from the process's own to the root. Version 1: two
// files. No such file: no limit.
unsigned threads_of_cgroup() {
  unsigned least = 4096;
  std::ifstream groups("/proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {
    if (!line.starts_with("0::")) continue;
    for (std::string group = line.substr(3);; group.erase(group.find_last_of('/'))) {
      std::ifstream limit("/sys/fs/cgroup" + group + "/cpu.max");
      std::string quota;
      double period = 0;
      if (limit >> quota >> period && quota != "max")
        least = std::min(least, whole_processors(std::stod(quota), period));
      if (group.find('/') == std::string::npos) break;
    }
  }
  std::ifstream quota_file("/sys/fs/cgroup/cpu/cpu.cfs_quota_us"), period_file("/sys/fs/cgroup/cpu/cpu.cfs_period_us");
  double quota = 0, period = 0;
  if (quota_file >> quota && period_file >> period && quota > 0)
    least = std::min(least, whole_processors(quota, period));
  return least;
}

}  // namespace

unsigned allowed_threads() { return std::max(1u, std::min(threads_of_affinity(), threads_of_cgroup())); }

}  // namespace limber::tool
