// SPDX-License-Identifier: Apache-2.0
// Where a verb says what it has to say: results on standard output, as text or as JSON; messages on standard error.
#pragma once

#include <cstdio>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>

#include "limber/base/result.h"
#include "tool/exit.h"

namespace limber::tool {

using Json = nlohmann::ordered_json;  // members in the order in which they are set

// The options that all verbs have.
struct Conventions {
  bool json = false;     // --json
  bool quiet = false;    // -q
  unsigned threads = 1;  // -j, with 0 resolved; >= 1
};

class Console {
 public:
  Console(std::FILE* out, std::FILE* err) : out_(out), err_(err) {}

  Conventions conventions;

  // Results for people; nothing with --json. No newline is added.
  template <class... Arguments>
  void print(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    if (!conventions.json) write(out_, fmt::format(format, std::forward<Arguments>(arguments)...));
  }

  // Results for machines: only with --json, where it is the only thing on standard output. `schema` is a name and a
  // version, "limber.info/1".
  void report(std::string_view schema, const Json& members);

  // The same of a document that has its schema in it; `members` stand before its own.
  void report_with(const Json& members, Json document);

  // A message; nothing with -q. A newline is added.
  template <class... Arguments>
  void note(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    if (!conventions.quiet) say(fmt::format(format, std::forward<Arguments>(arguments)...));
  }

  // The same, with -q too.
  template <class... Arguments>
  void warn(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    say(fmt::format("warning: {}", fmt::format(format, std::forward<Arguments>(arguments)...)));
  }

  // One line on standard error, and with --json the same on standard output. Gives `exit`.
  Exit fail(const Error& error, Exit exit, std::string_view name);

  // Text as it is: help and versions.
  void write_out(std::string_view text) { write(out_, text); }

  // For `-o -`: bytes go to standard output, and the results to standard error.
  Result<void> write_bytes(std::span<const char> bytes);
  void results_go_to_standard_error() { out_ = err_; }

  // Are progress bars welcome?
  bool shows_progress() const;
  bool uses_color() const;
  // Replaces the line that is being shown; an empty one removes it.
  void show_line(std::string_view line);

  // Hands everything to the system. A reader that has gone away is no error; a full disk is.
  Result<void> flush();

 private:
  void write(std::FILE* file, std::string_view text);
  void say(std::string_view line);

  std::FILE* out_;
  std::FILE* err_;
  int write_error_ = 0;  // the first errno of writing to out_
  bool line_is_shown_ = false;
};

// The text with control characters as \x1b, so that a name in a message cannot break its line.
std::string one_line(std::string_view text);

}  // namespace limber::tool
