// SPDX-License-Identifier: Apache-2.0
// A position in a text of words and numbers, with its line. Lines end with LF, CR LF or CR; '#' starts a comment
// that lasts to the end of its line; a backslash before a line end joins two lines.
#pragma once

#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <system_error>

#include "limber/base/result.h"

namespace limber {

class TextScanner {
 public:
  // `text` must outlive the scanner; `line` is the number of its first line.
  explicit TextScanner(std::string_view text, std::uint64_t line = 1)
      : next_(text.data()), end_(text.data() + text.size()), line_(line) {}

  std::uint64_t line() const { return line_; }
  std::size_t remaining() const { return static_cast<std::size_t>(end_ - next_); }
  bool at_end() const { return next_ == end_; }
  bool at_line_end() const { return next_ == end_ || is_line_end(*next_) || *next_ == '#'; }

  void skip_blanks() {
    while (next_ != end_) {
      if (is_blank(*next_)) {
        ++next_;
      } else if (*next_ == '\\' && next_ + 1 != end_ && is_line_end(next_[1])) {
        ++next_;
        skip_line_end();
      } else {
        return;
      }
    }
  }

  // To the first byte of the next line.
  void skip_line() {
    while (next_ != end_ && !is_line_end(*next_)) ++next_;
    skip_line_end();
  }

  // To the next word, over blanks, comments and line ends.
  void skip_to_word() {
    skip_blanks();
    while (!at_end() && at_line_end()) {
      skip_line();
      skip_blanks();
    }
  }

  // The bytes up to the next blank or line end; empty at the end of the line.
  std::string_view word() {
    skip_blanks();
    const char* begin = next_;
    while (next_ != end_ && !is_blank(*next_) && !is_line_end(*next_)) ++next_;
    return {begin, static_cast<std::size_t>(next_ - begin)};
  }

  // The next three read a number and give false, without moving past it, where there is none. What is too small
  // for a float becomes zero, what is too large infinite.
  bool read(float& value) {
    skip_blanks();
    const char* begin = next_ != end_ && *next_ == '+' ? next_ + 1 : next_;
    const auto [stop, error] = std::from_chars(begin, end_, value);
    if (error == std::errc::result_out_of_range) {
      value = out_of_range(begin, stop);
    } else if (error != std::errc{}) {
      return false;
    }
    return finish_word(stop);
  }

  bool read(std::int64_t& value) {
    const char* start = next_;
    if (read_digits(value) && finish_word(next_)) return true;
    next_ = start;
    return false;
  }

  // An integer with anything behind it.
  bool read_digits(std::int64_t& value) {
    skip_blanks();
    const auto [stop, error] = std::from_chars(next_, end_, value);
    if (error != std::errc{}) return false;
    next_ = stop;
    return true;
  }

  // Skips the bytes that are among `bytes`; true where a blank or the end of the line follows.
  bool skip_rest_of_word(std::string_view bytes) {
    while (next_ != end_ && bytes.find(*next_) != std::string_view::npos) ++next_;
    return finish_word(next_);
  }

 private:
  static bool is_blank(char c) { return c == ' ' || c == '\t'; }
  static bool is_line_end(char c) { return c == '\n' || c == '\r'; }

  void skip_line_end() {
    if (next_ == end_) return;
    if (*next_ == '\r' && next_ + 1 != end_ && next_[1] == '\n') ++next_;
    ++next_;
    ++line_;
  }

  bool finish_word(const char* stop) {
    if (stop != end_ && !is_blank(*stop) && !is_line_end(*stop) && *stop != '#' && *stop != '\\') return false;
    next_ = stop;
    return true;
  }

  static float out_of_range(const char* begin, const char* stop) {
    double value = 0;
    if (std::from_chars(begin, stop, value).ec == std::errc{}) return static_cast<float>(value);
    const std::string_view text(begin, static_cast<std::size_t>(stop - begin));
    const bool tiny = text.find("e-") != std::string_view::npos || text.find("E-") != std::string_view::npos;
    return tiny ? 0.0f : std::numeric_limits<float>::infinity();
  }

  const char* next_;
  const char* end_;
  std::uint64_t line_;
};

// An error at a line of a text file.
inline Error error_at_line(ErrorCode code, std::string_view name, std::uint64_t line, std::string what) {
  return {code, std::string(name) + ":" + std::to_string(line), std::move(what)};
}

}  // namespace limber
