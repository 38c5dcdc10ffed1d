// SPDX-License-Identifier: Apache-2.0
// Numbers, names and bytes as a page of HTML holds them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace limber::eval {

// Text for HTML and SVG, in elements and in quoted attributes: markup characters as entities, control characters and
// bytes that are not UTF-8 as the replacement character.
std::string escaped(std::string_view text);

// So many significant digits, 1 to 9, without an exponent from 0.0001 to 9,999,999, and beyond as "3.70×10⁻⁷"; from
// 1,000 on with commas. "0" for zero, a dash for what is no finite number.
std::string number(double value, int digits = 3);
std::string number(std::optional<double> value, int digits = 3);

// 8431 as "8,431".
std::string count(std::uint64_t value);

// Bytes as "812 B", "10.7 KB", "3.21 MB": powers of 1,000.
std::string byte_count(double bytes);

std::string base64(std::span<const std::byte> bytes);

}  // namespace limber::eval
