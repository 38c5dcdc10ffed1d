// SPDX-License-Identifier: Apache-2.0
#include "eval/report/words.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace limber::eval {
namespace {

constexpr const char* kReplacement = "\xef\xbf\xbd";
constexpr const char* kDash = "\xe2\x80\x93";
constexpr const char* kMinus = "\xe2\x88\x92";

// The length of the UTF-8 sequence that the text starts with, 0 where it is none.
std::size_t sequence_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  const std::size_t length = first < 0x80                    ? 1
                             : first >= 0xc2 && first < 0xe0 ? 2
                             : first >= 0xe0 && first < 0xf0 ? 3
                             : first >= 0xf0 && first < 0xf5 ? 4
                                                             : 0;
  if (length == 0 || length > text.size()) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return 0;
  }
  if ((first == 0xe0 && byte(1) < 0xa0) || (first == 0xed && byte(1) >= 0xa0)) return 0;
  if ((first == 0xf0 && byte(1) < 0x90) || (first == 0xf4 && byte(1) >= 0x90)) return 0;
  return length;
}

std::string_view entity(char c) {
  switch (c) {
    case '&':
      return "&amp;";
    case '<':
      return "&lt;";
    case '>':
      return "&gt;";
    case '"':
      return "&quot;";
    case '\'':
      return "&#39;";
    default:
      return {};
  }
}

std::string with_commas(std::string digits) {
  const std::size_t point = std::min(digits.find('.'), digits.size());
  for (std::size_t at = point; at > 3;) digits.insert(at -= 3, 1, ',');
  return digits;
}

std::string superscript(int exponent) {
  static constexpr const char* kDigits[] = {"\xe2\x81\xb0", "\xc2\xb9",     "\xc2\xb2",     "\xc2\xb3",
                                            "\xe2\x81\xb4", "\xe2\x81\xb5", "\xe2\x81\xb6", "\xe2\x81\xb7",
                                            "\xe2\x81\xb8", "\xe2\x81\xb9"};
  std::string text = exponent < 0 ? "\xe2\x81\xbb" : "";
  for (const char digit : fmt::format("{}", std::abs(exponent))) text += kDigits[digit - '0'];
  return text;
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const std::size_t length = sequence_length(text);
    const char c = text.front();
    const auto code = static_cast<unsigned char>(c);
    if (length == 0 || (code < 0x20 && c != '\n' && c != '\t') || code == 0x7f) {
      result += kReplacement;
    } else if (const std::string_view name = entity(c); !name.empty()) {
      result += name;
    } else {
      result += text.substr(0, length);
    }
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return result;
}

std::string number(double value, int digits) {
  if (!std::isfinite(value)) return kDash;
  if (value == 0) return "0";
  const std::string sign = value < 0 ? kMinus : "";
  // Rounded first, so that 9.996 has the digits of 10.
  const std::string rounded = fmt::format("{:.{}e}", std::abs(value), digits - 1);
  const std::size_t e = rounded.find('e');
  const int exponent = std::stoi(rounded.substr(e + 1));
  if (exponent < -4 || exponent > 6) return sign + rounded.substr(0, e) + "\xc3\x97" + "10" + superscript(exponent);
  return sign + with_commas(fmt::format("{:.{}f}", std::abs(value), std::max(0, digits - 1 - exponent)));
}

std::string number(std::optional<double> value, int digits) { return value ? number(*value, digits) : kDash; }

std::string count(std::uint64_t value) { return with_commas(fmt::format("{}", value)); }

std::string byte_count(double bytes) {
  if (bytes < 999.5) return fmt::format("{:.0f} B", bytes);
  for (const char* const unit : {"KB", "MB", "GB"}) {
    bytes /= 1000;
    if (bytes < 999.5) return fmt::format("{} {}", number(bytes), unit);
  }
  return fmt::format("{} TB", number(bytes / 1000));
}

std::string base64(std::span<const std::byte> bytes) {
  static constexpr char kLetters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t taken = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (k < taken ? std::to_integer<std::uint32_t>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += k <= taken ? kLetters[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

}  // namespace limber::eval
