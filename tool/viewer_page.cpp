// SPDX-License-Identifier: Apache-2.0
#include "tool/viewer_page.h"

#include <cassert>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>

namespace limber::tool {
namespace {

constexpr std::string_view kStreamMark = "<!-- stream -->";

std::string base64(std::span<const std::byte> bytes) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto at = [&](std::size_t k) { return k < bytes.size() ? std::to_integer<unsigned>(bytes[k]) : 0u; };
    const unsigned group = at(i) << 16 | at(i + 1) << 8 | at(i + 2);
    text += kDigits[group >> 18];
    text += kDigits[group >> 12 & 63];
    text += i + 1 < bytes.size() ? kDigits[group >> 6 & 63] : '=';
    text += i + 2 < bytes.size() ? kDigits[group & 63] : '=';
  }
  return text;
}

std::string in_attribute(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

}  // namespace

Result<std::string> read_viewer_page() {
  std::error_code failed;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", failed);
  const std::filesystem::path path = program.parent_path().parent_path() / "share/limber/viewer.html";
  std::ifstream file(path, std::ios::binary);
  std::string page{std::istreambuf_iterator<char>(file), {}};
  if (page.find(kStreamMark) == std::string::npos)
    return Error{ErrorCode::kNotFound, path.string(),
                 "this limber was built without its viewer; install what that needs (scripts/setup web: node, npm and "
                 "clang for WebAssembly) and build again"};
  return page;
}

std::string with_stream(std::string_view page, std::span<const std::byte> stream, std::string_view name) {
  const std::size_t at = page.find(kStreamMark);
  assert(at != std::string_view::npos);
  std::string whole(page.substr(0, at));
  whole += "<script type=\"text/plain\" id=\"limber-stream\" data-name=\"";
  whole += in_attribute(name);
  whole += "\">";
  whole += base64(stream);
  whole += "</script>";
  whole += page.substr(at + kStreamMark.size());
  return whole;
}

}  // namespace limber::tool
