// SPDX-License-Identifier: Apache-2.0
#include "tool/progress.h"

#include <algorithm>
#include <cmath>

#include "tool/interrupt.h"

namespace limber::tool {
namespace {

constexpr std::size_t kBarWidth = 24;

std::string duration(double seconds) {
  const auto whole = static_cast<std::uint64_t>(std::ceil(seconds));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{}:{:02} min", whole / 60, whole % 60);
  return fmt::format("{}:{:02} h", whole / 3600, whole / 60 % 60);
}

}  // namespace

std::string progress_line(std::string_view what, std::uint64_t done, std::optional<std::uint64_t> total,
                          double seconds) {
  const double rate = seconds > 0 ? static_cast<double>(done) / seconds : 0.0;
  const std::string speed = done > 0 && rate > 0 ? fmt::format("  {:.3g}/s", rate) : "";
  if (!total || *total == 0) return fmt::format("{}  {} frames{}", what, done, speed);
  done = std::min(done, *total);
  const auto filled = static_cast<std::size_t>(kBarWidth * done / *total);
  std::string bar(filled, '=');
  if (filled < kBarWidth) bar += '>';
  bar.resize(kBarWidth, ' ');
  const std::string left =
      speed.empty() ? "" : fmt::format("  {} left", duration(static_cast<double>(*total - done) / rate));
  return fmt::format("{} [{}] {}/{} frames{}{}", what, bar, done, *total, speed, left);
}

Progress::Progress(Console& console, std::string_view what, std::optional<std::uint64_t> total)
    : console_(console), is_shown_(console.shows_progress()) {
  start(what, total);
}

void Progress::start(std::string_view what, std::optional<std::uint64_t> total) {
  what_ = what;
  total_ = total;
  started_ = Clock::now();
  last_shown_ = {};
}

bool Progress::update(std::uint64_t done) {
  const Clock::time_point now = Clock::now();
  if (is_shown_ && now - last_shown_ >= std::chrono::milliseconds(100)) {
    last_shown_ = now;
    const std::string line = progress_line(what_, done, total_, std::chrono::duration<double>(now - started_).count());
    console_.show_line(console_.uses_color() ? fmt::format("\x1b[32m{}\x1b[0m", line) : line);
  }
  return !interrupted();
}

Error interruption() { return {ErrorCode::kCancelled, "", "interrupted; no output was written"}; }

}  // namespace limber::tool
