// SPDX-License-Identifier: Apache-2.0
// How far long work has come: a bar on a terminal, and the question whether to stop.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "tool/console.h"

namespace limber::tool {

// "reading [=====>    ]  31/60 frames  12.4/s  3 s left"; without a total, no bar and no time.
std::string progress_line(std::string_view what, std::uint64_t done, std::optional<std::uint64_t> total,
                          double seconds);

class Progress {
 public:
  // `what` is being done, in frames.
  Progress(Console& console, std::string_view what, std::optional<std::uint64_t> total = {});
  ~Progress() { finish(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // Something else is done from now on.
  void start(std::string_view what, std::optional<std::uint64_t> total = {});

  // So much is done. False: stop, a signal has come.
  [[nodiscard]] bool update(std::uint64_t done);

  // Removes the bar.
  void finish() { console_.show_line(""); }

 private:
  using Clock = std::chrono::steady_clock;

  Console& console_;
  bool is_shown_;
  std::string what_;
  std::optional<std::uint64_t> total_;
  Clock::time_point started_;
  Clock::time_point last_shown_;
};

// The error of work that a signal has stopped.
Error interruption();

}  // namespace limber::tool
