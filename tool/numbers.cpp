// SPDX-License-Identifier: Apache-2.0
#include "tool/numbers.h"

#include <charconv>
#include <cmath>

namespace limber::tool {

bool parse_numbers(std::string_view text, std::span<double> numbers) {
  const char* at = text.data();
  const char* const last = at + text.size();
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const auto [end, error] = std::from_chars(at, last, numbers[i]);
    if (error != std::errc{} || !std::isfinite(numbers[i])) return false;
    at = end;
    const bool is_last = i + 1 == numbers.size();
    if ((at == last) != is_last || (!is_last && *at++ != ',')) return false;
  }
  return true;
}

}  // namespace limber::tool
