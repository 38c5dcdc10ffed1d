// SPDX-License-Identifier: Apache-2.0
// Is a page of HTML or SVG well formed?
#pragma once

#include <cctype>
#include <string>
#include <string_view>
#include <vector>

namespace limber::test {

// What is wrong first, in words; empty where every element is closed in its turn, every attribute is quoted, and every
// & begins an entity. Style is not looked into.
inline std::string markup_fault(std::string_view page) {
  std::vector<std::string> open;
  for (std::size_t at = 0; at < page.size();) {
    if (page[at] == '&') {
      const std::size_t end = page.find(';', at);
      if (end == std::string_view::npos || end - at > 8) return "an & that begins no entity";
      at = end + 1;
      continue;
    }
    if (page[at] == '>') return "a > outside of a tag";
    if (page[at] != '<') {
      ++at;
      continue;
    }
    const std::size_t begin = at;
    bool quoted = false;
    for (++at; at < page.size() && (quoted || page[at] != '>'); ++at) {
      if (page[at] == '"') quoted = !quoted;
      if (!quoted && page[at] == '=' && (at + 1 == page.size() || page[at + 1] != '"'))
        return "an attribute without quotes";
      if (page[at] == '<') return "a < inside of a tag";
    }
    if (at == page.size()) return "a tag without an end";
    const std::string_view tag = page.substr(begin + 1, at++ - begin - 1);
    if (tag.starts_with('!') || tag.ends_with('/')) continue;
    const std::size_t first = tag.starts_with('/') ? 1 : 0;
    std::string name;
    for (std::size_t i = first; i < tag.size() && std::isalnum(static_cast<unsigned char>(tag[i])) != 0; ++i)
      name += tag[i];
    if (first == 0) {
      open.push_back(name);
      if (name == "style") at = page.find("</style>", at);
      if (at == std::string_view::npos) return "style without an end";
    } else if (open.empty() || open.back() != name) {
      return "</" + name + "> closes " + (open.empty() ? "nothing" : open.back());
    } else {
      open.pop_back();
    }
  }
  return open.empty() ? "" : "<" + open.back() + "> is never closed";
}

}  // namespace limber::test
