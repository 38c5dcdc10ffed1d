// SPDX-License-Identifier: Apache-2.0
#include "tool/frames_argument.h"

#include <charconv>
#include <string_view>

namespace limber::tool {
namespace {

// Takes a number off the front of the text, if there is one.
std::optional<std::uint32_t> take_number(std::string_view& text) {
  std::uint32_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc()) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return number;
}

bool take(std::string_view& text, char c) {
  if (text.empty() || text.front() != c) return false;
  text.remove_prefix(1);
  return true;
}

// "7", "1-100", "5-", "-20", and any of them with a step, as in "1-100x2".
bool parse(std::string_view text, ClipOptions& options) {
  options.first = take_number(text);
  if (take(text, '-')) {
    options.last = take_number(text);
    if (!options.first && !options.last) return false;
  } else if (options.first) {
    options.last = options.first;
  }
  if (take(text, 'x')) {
    const std::optional<std::uint32_t> step = take_number(text);
    if (!step || *step == 0) return false;
    options.step = *step;
  } else if (!options.first && !options.last) {
    return false;
  }
  return text.empty();
}

}  // namespace

void declare_frames(CLI::App& app, ClipOptions& options) {
  CLI::Option* const first =
      app.add_option("--first", options.first, "first frame, as the source numbers them")->type_name("N");
  CLI::Option* const last =
      app.add_option("--last", options.last, "last frame, as the source numbers them")->type_name("N");
  app.add_option_function<std::string>(
         "--frames",
         [&options](const std::string& text) {
           if (!parse(text, options))
             throw CLI::ValidationError("--frames", text + " is no range of frames; 7, 1-100, 5- and 1-100x2 are");
         },
         "frames as in 7, 1-100, 5- or, every second one, 1-100x2; outputs are numbered on from the first")
      ->type_name("RANGE")
      ->excludes(first)
      ->excludes(last);
}

bool is_part(const ClipOptions& options) { return options.first || options.last || options.step != 1; }

void copy_part(const ClipOptions& from, ClipOptions& to) {
  to.first = from.first;
  to.last = from.last;
  to.step = from.step;
}

}  // namespace limber::tool
