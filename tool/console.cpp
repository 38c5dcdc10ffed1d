// SPDX-License-Identifier: Apache-2.0
#include "tool/console.h"

#include <cerrno>
#include <cstdlib>
#include <system_error>
#include <unistd.h>

namespace limber::tool {
namespace {

bool is_terminal(std::FILE* file) { return fileno(file) >= 0 && isatty(fileno(file)) != 0; }

bool is_set(const char* variable) {
  const char* value = std::getenv(variable);
  return value != nullptr && *value != '\0';
}

}  // namespace

std::string one_line(std::string_view text) {
  std::string line;
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (code < 0x20 || code == 0x7f) {
      line += fmt::format("\\x{:02x}", code);
    } else {
      line += c;
    }
  }
  return line;
}

void Console::write(std::FILE* file, std::string_view text) {
  errno = 0;
  if (std::fwrite(text.data(), 1, text.size(), file) != text.size() && file == out_ && write_error_ == 0)
    write_error_ = errno != 0 ? errno : EIO;
}

void Console::say(std::string_view line) {
  show_line("");
  write(err_, fmt::format("limber: {}\n", one_line(line)));
}

void Console::report(std::string_view schema, const Json& members) {
  if (!conventions.json) return;
  Json document;
  document["schema"] = schema;
  document.update(members);
  // Names of files need not be UTF-8, but JSON must.
  write(out_, document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

void Console::report_with(const Json& members, Json document) {
  const std::string schema = document.at("schema");
  document.erase("schema");
  Json all = members;
  all.update(document);
  report(schema, all);
}

Exit Console::fail(const Error& error, Exit exit, std::string_view name) {
  say(error.line());
  report("limber.error/1",
         {{"code", name}, {"exit", static_cast<int>(exit)}, {"where", error.where}, {"what", error.what}});
  return exit;
}

Result<void> Console::write_bytes(std::span<const char> bytes) {
  errno = 0;
  if (std::fwrite(bytes.data(), 1, bytes.size(), stdout) == bytes.size()) return {};
  return Error{ErrorCode::kIo, "standard output",
               fmt::format("cannot be written: {}", std::generic_category().message(errno != 0 ? errno : EIO))};
}

bool Console::shows_progress() const {
  const char* kind = std::getenv("TERM");
  return !conventions.quiet && is_terminal(err_) && !(kind != nullptr && std::string_view(kind) == "dumb");
}

bool Console::uses_color() const { return shows_progress() && !is_set("NO_COLOR"); }

void Console::show_line(std::string_view line) {
  if (line.empty() && !line_is_shown_) return;
  write(err_, fmt::format("\r\x1b[K{}", line));
  std::fflush(err_);
  line_is_shown_ = !line.empty();
}

Result<void> Console::flush() {
  std::fflush(err_);
  errno = 0;
  if (std::fflush(out_) != 0 && write_error_ == 0) write_error_ = errno != 0 ? errno : EIO;
  if (write_error_ == 0 || write_error_ == EPIPE) return {};
  return Error{ErrorCode::kIo, "standard output",
               fmt::format("cannot be written: {}", std::generic_category().message(write_error_))};
}

}  // namespace limber::tool
