// SPDX-License-Identifier: Apache-2.0
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <memory>
#include <optional>
#include <spawn.h>
#include <string>
#include <unistd.h>

#include "limber/clip/input_file.h"
#include "limber/clip/output_file.h"
#include "tool/output_argument.h"
#include "tool/ranges.h"
#include "tool/stream_file.h"
#include "tool/stream_server.h"
#include "tool/verb.h"
#include "tool/viewer_page.h"

namespace limber::tool {
namespace {

struct Arguments {
  std::string file;
  std::uint16_t port = 0;
  bool stays_closed = false;  // --no-open
  OutputArgument page;        // --export; no path: serve
};

// As part of an address.
std::string percent_encoded(const std::string& name) {
  constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-._~";
  std::string encoded;
  for (const char c : name) {
    if (kPlain.find(c) != std::string_view::npos)
      encoded += c;
    else
      encoded += fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return encoded;
}

// The desktop's browser, where there is a desktop. Whether it opens is the user's to see.
void open_browser(const std::string& url) {
  if (!std::getenv("DISPLAY") && !std::getenv("WAYLAND_DISPLAY")) return;
  posix_spawn_file_actions_t quiet;
  posix_spawn_file_actions_init(&quiet);
  posix_spawn_file_actions_addopen(&quiet, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&quiet, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  std::string program = "xdg-open", address = url;
  char* const words[] = {program.data(), address.data(), nullptr};
  pid_t ignored;
  posix_spawnp(&ignored, program.c_str(), &quiet, nullptr, words, environ);
  posix_spawn_file_actions_destroy(&quiet);
}

Result<Exit> export_page(const Arguments& arguments, const StreamFile& file, const std::string& page,
                         const std::string& name, Console& console) {
  Result<OutputFile> output = OutputFile::create(arguments.page.path, arguments.page.replace);
  if (!output) return output.error();
  const std::string whole = with_stream(page, file.bytes(), name);
  if (Result<void> written = output->write({whole.data(), whole.size()}); !written) return written.error();
  if (Result<void> committed = output->commit(); !committed) return committed.error();
  console.print("{}: {} bytes, {} of them the stream\n", one_line(arguments.page.path), whole.size(),
                file.bytes().size());
  console.report("limber.view/1", {{"file", file.name()}, {"page", arguments.page.path}, {"bytes", whole.size()}});
  return Exit::kDone;
}

Result<Exit> view(const Arguments& arguments, Console& console) {
  const bool is_export = !arguments.page.path.empty();
  if (is_export && lower_case_extension(arguments.page.path) != ".html")
    throw UsageError(fmt::format("what --export writes is a page, so its name must end in .html, not as {} does",
                                 one_line(arguments.page.path)));
  if (!is_export && arguments.page.replace) throw UsageError("-f goes with --export alone");
  const Result<StreamFile> file = StreamFile::open(arguments.file);
  if (!file) return file.error();
  if (const Result<Decoder> decoder = open_decoder(*file); !decoder) return decoder.error();
  Result<std::string> page = read_viewer_page();
  if (!page) return page.error();
  const std::string name =
      arguments.file == "-" ? "stream.limber" : std::filesystem::path(arguments.file).filename().string();
  if (is_export) return export_page(arguments, *file, *page, name, console);

  StreamServer server(std::move(*page), file->bytes());
  const Result<std::uint16_t> port = server.bind(arguments.port);
  if (!port) return port.error();
  const std::string url = fmt::format("http://127.0.0.1:{}/?stream=stream/{}", *port, percent_encoded(name));
  console.print("{}\n", url);
  console.report("limber.view/1", {{"file", file->name()}, {"url", url}});
  if (Result<void> flushed = console.flush(); !flushed) return flushed.error();
  console.note("the viewer is at this address until you press Ctrl-C");
  if (!arguments.stays_closed) open_browser(url);
  server.serve();
  return Exit::kDone;
}

}  // namespace

Action declare_view(CLI::App& app) {
  const auto arguments = std::make_shared<Arguments>();
  app.add_option("FILE", arguments->file, "a stream; - for standard input")->required();
  app.add_option("--port", arguments->port, "of the address on this machine; 0 for a free one")
      ->check(in_range(0, 65535))
      ->type_name("N")
      ->default_str("0");
  app.add_flag("--no-open", arguments->stays_closed, "print the address, and do not open a browser");
  app.add_option("--export", arguments->page.path,
                 "write the viewer with the stream as one page, which needs no server: page.html")
      ->type_name("PAGE");
  app.add_flag("-f,--force", arguments->page.replace, "replace a page that is already there");
  return [arguments](Console& console) { return view(*arguments, console); };
}

}  // namespace limber::tool
