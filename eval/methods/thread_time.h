// SPDX-License-Identifier: Apache-2.0
// Processor time of the calling thread: what a step costs, whatever else the machine is doing.
#pragma once

#include <ctime>

namespace limber::eval {

class ThreadTimer {
 public:
  double seconds() const { return now() - start_; }

 private:
  static double now() {
    std::timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  }

  double start_ = now();
};

}  // namespace limber::eval
