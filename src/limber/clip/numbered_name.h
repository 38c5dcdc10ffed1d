// SPDX-License-Identifier: Apache-2.0
// File names with one number in them, as printf makes them, and the order of names with numbers in them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "limber/base/result.h"

namespace limber {

// `prefix`, a number of at least `digit_count` digits, filled up with zeros, and `suffix`.
struct NumberedName {
  std::string prefix;
  std::string suffix;
  std::uint32_t digit_count = 1;

  std::string name(std::uint64_t number) const;

  // The number that gives this name; nothing where none does.
  std::optional<std::uint32_t> number(std::string_view name) const;

  // Does it have a percent sign, so that it is meant for parse()?
  static bool is_pattern(std::string_view pattern);

  // One number, `%d` or `%04d` (also `i` or `u`), and `%%` for a percent sign. Anything else is kBadInput.
  static Result<NumberedName> parse(std::string_view pattern);
};

// Is `a` before `b` when digits in a row count as one number? `2.obj` is before `10.obj`.
bool natural_less(std::string_view a, std::string_view b);

}  // namespace limber
