// SPDX-License-Identifier: Apache-2.0
#include "tool/ranges.h"

#include <fmt/format.h>
#include <optional>

namespace limber::tool {
namespace {

std::optional<double> number(const std::string& text) {
  double value = 0;
  if (!CLI::detail::lexical_cast(text, value)) return std::nullopt;
  return value;
}

}  // namespace

CLI::Validator in_range(double low, double high) {
  return CLI::Validator(
      [low, high](std::string& text) {
        const std::optional<double> value = number(text);
        return value && *value >= low && *value <= high ? std::string()
                                                        : fmt::format("{} is not from {} to {}", text, low, high);
      },
      "");
}

CLI::Validator above_zero(double high) {
  return CLI::Validator(
      [high](std::string& text) {
        const std::optional<double> value = number(text);
        return value && *value > 0 && *value <= high ? std::string()
                                                     : fmt::format("{} is not above 0 and up to {}", text, high);
      },
      "");
}

}  // namespace limber::tool
