// SPDX-License-Identifier: Apache-2.0
#include "limber/clip/numbered_name.h"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>

namespace limber {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// The digits in a row at `begin`, without zeros in front; moves `begin` behind them.
std::string_view take_number(std::string_view text, std::size_t& begin) {
  const std::size_t start = begin;
  while (begin < text.size() && is_digit(text[begin])) ++begin;
  std::string_view digits = text.substr(start, begin - start);
  while (digits.size() > 1 && digits.front() == '0') digits.remove_prefix(1);
  return digits;
}

}  // namespace

std::string NumberedName::name(std::uint64_t number) const {
  return fmt::format("{}{:0{}}{}", prefix, number, digit_count, suffix);
}

std::optional<std::uint32_t> NumberedName::number(std::string_view text) const {
  if (text.size() <= prefix.size() + suffix.size() || !text.starts_with(prefix) || !text.ends_with(suffix)) {
    return std::nullopt;
  }
  const std::string_view digits = text.substr(prefix.size(), text.size() - prefix.size() - suffix.size());
  std::uint32_t value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc{} || end != digits.data() + digits.size() || name(value) != text) return std::nullopt;
  return value;
}

bool NumberedName::is_pattern(std::string_view pattern) { return pattern.find('%') != std::string_view::npos; }

Result<NumberedName> NumberedName::parse(std::string_view pattern) {
  const Error error{ErrorCode::kBadInput, std::string(pattern),
                    "a pattern needs one frame number, %d or %04d (a percent sign is %%)"};
  NumberedName result;
  bool found = false;
  for (std::size_t i = 0; i < pattern.size(); ++i) {
    std::string& text = found ? result.suffix : result.prefix;
    if (pattern[i] != '%') {
      text += pattern[i];
      continue;
    }
    if (++i < pattern.size() && pattern[i] == '%') {
      text += '%';
      continue;
    }
    const bool zeros = i < pattern.size() && pattern[i] == '0';
    std::size_t stop = i;
    const std::string_view width = take_number(pattern, stop);
    // A width without a zero would fill up with blanks, which no sequence has.
    if (found || stop >= pattern.size() || width.size() > 1 || (stop != i && !zeros)) return error;
    if (pattern[stop] != 'd' && pattern[stop] != 'i' && pattern[stop] != 'u') return error;
    if (stop != i) result.digit_count = std::max(1u, static_cast<std::uint32_t>(width[0] - '0'));
    found = true;
    i = stop;
  }
  if (!found) return error;
  return result;
}

bool natural_less(std::string_view a, std::string_view b) {
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < a.size() && j < b.size()) {
    if (is_digit(a[i]) && is_digit(b[j])) {
      const std::string_view m = take_number(a, i);
      const std::string_view n = take_number(b, j);
      if (m.size() != n.size()) return m.size() < n.size();
      if (m != n) return m < n;
    } else {
      if (a[i] != b[j]) return static_cast<unsigned char>(a[i]) < static_cast<unsigned char>(b[j]);
      ++i, ++j;
    }
  }
  if (i < a.size() || j < b.size()) return i >= a.size();
  return a < b;  // `1` and `01`
}

}  // namespace limber
