// SPDX-License-Identifier: Apache-2.0
#include "tool/program.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <filesystem>
#include <memory>
#include <new>
#include <optional>
#include <system_error>
#include <tbb/global_control.h>
#include <vector>

#include "limber/clip/mesh_file.h"
#include "tool/help_formatter.h"
#include "tool/ranges.h"
#include "tool/suggest.h"
#include "tool/threads.h"
#include "tool/verb.h"

namespace limber::tool {
namespace {

constexpr std::string_view kReads =
    "Reads: .obj .ply .off (single meshes, or numbered frames); .pc2 .mdd (with a mesh); .limber; sample:NAME";
constexpr std::string_view kWrites = "Writes: .limber; .obj .ply .off (single meshes, or numbered frames); .pc2 .mdd";

std::string version_text() {
  return fmt::format("limber {}\n\n{}\n{}\n\nLicence: Apache-2.0\n", LIMBER_PROGRAM_VERSION, kReads, kWrites);
}

std::string help_text() {
  std::string text =
      "limber turns an animated triangle mesh into a multiresolution stream that follows the deformation, and cuts any "
      "level of\ndetail of any frame out of it.\n\nUsage: limber VERB INPUT... -o OUTPUT\n\nVerbs:\n";
  for (const Verb& verb : verbs()) text += fmt::format("  {:<12} {}\n", verb.name, verb.summary);
  text += fmt::format(
      "\n"
      "Options of all verbs:\n"
      "  -h, --help   the verb's own help, with examples\n"
      "  -j N         threads; 0, the default, for all that the process may use\n"
      "  -q, --quiet  no messages and no progress\n"
      "  --json       results, and errors, as JSON on standard output\n"
      "\n"
      "Other options:\n"
      "  --version    the version, and the formats it reads and writes\n"
      "\n"
      "{}\n{}\n\n"
      "A CLIP is a printf pattern, quoted glob or folder of numbered frames, a point cache with its mesh, a stream, a\n"
      "generated sample, or a single mesh. Outputs take their format from the name; one that is already there is\n"
      "replaced only with -f, and only by a whole one.\n"
      "\n"
      "Exit status: 0 done, 1 failure, 2 usage, 3 bad input, 4 a check failed, 130 interrupted.\n",
      kReads, kWrites);
  return text +
         "\nExamples:\n"
         "  limber build 'horse/%04d.obj' -o horse.limber\n"
         "  limber info horse.limber\n"
         "  limber extract horse.limber --frame 12 --vertices 800 -o horse12.ply\n";
}

Exit fail_usage(Console& console, std::string_view where, std::string what) {
  return console.fail({ErrorCode::kBadInput, std::string(where), std::move(what)}, Exit::kUsage, "usage");
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates) {
  const std::string meant = nearest(word, candidates);
  return meant.empty() ? "" : fmt::format("did you mean {}? ", meant);
}

const Verb* find_verb(std::string_view name) {
  const auto found = std::find_if(verbs().begin(), verbs().end(), [&](const Verb& v) { return v.name == name; });
  return found == verbs().end() ? nullptr : &*found;
}

std::string unknown_verb(std::string_view name) {
  std::vector<std::string> names;
  for (const Verb& verb : verbs()) names.emplace_back(verb.name);
  return fmt::format("there is no verb \"{}\"; {}\"limber --help\" lists them", name, did_you_mean(name, names));
}

// What is wrong with the first argument that the verb does not know.
std::string unexpected_argument(const CLI::App& app, const std::string& argument) {
  if (argument.starts_with('-') && argument != "-") {
    std::vector<std::string> names;
    for (const CLI::Option* option : app.get_options())
      for (const std::string& name : option->get_lnames()) names.push_back(fmt::format("--{}", name));
    const std::string typed = argument.substr(0, argument.find('='));
    return fmt::format("has no option {}; {}\"{} --help\" lists them", typed, did_you_mean(typed, names),
                       app.get_name());
  }
  std::error_code ignored;
  if (mesh_format(argument) && std::filesystem::exists(argument, ignored))
    return fmt::format("one argument too many: {}; put globs and patterns into quotes ('frames/*.obj')", argument);
  return fmt::format("one argument too many: {}; see \"{} --help\"", argument, app.get_name());
}

void declare_conventions(CLI::App& app, const Verb& verb, Conventions& conventions) {
  std::string footer = "Examples:\n";
  for (std::string_view rest = verb.examples; !rest.empty();) {
    const std::size_t end = std::min(rest.find('\n'), rest.size() - 1);
    footer += fmt::format("  {}\n", rest.substr(0, end));
    rest.remove_prefix(end + 1);
  }
  app.footer(footer);
  app.formatter(std::make_shared<HelpFormatter>());
  app.set_help_flag("-h,--help", "show this help");
  app.add_flag("--json", conventions.json, "results, and errors, as JSON on standard output");
  app.add_flag("-q,--quiet", conventions.quiet, "no messages and no progress");
  app.add_option("-j,--threads", conventions.threads, "threads; 0 for all that the process may use")
      ->check(in_range(0, 4096))
      ->type_name("N")
      ->default_str("0");
  app.allow_extras();
}

Exit fail(Console& console, const Error& error) {
  return console.fail(error, exit_for(error.code), name_of(error.code));
}

Exit act(const Action& action, Console& console, const std::string& name) {
  try {
    const Result<Exit> result = action(console);
    return result ? *result : fail(console, result.error());
  } catch (const UsageError& error) {
    return fail_usage(console, name, error.what());
  } catch (const std::bad_alloc&) {
    return console.fail({ErrorCode::kIo, "", "not enough memory"}, Exit::kFailure, "memory");
  } catch (const std::exception& error) {
    return console.fail({ErrorCode::kIo, "", fmt::format("unexpected: {}", error.what())}, Exit::kFailure, "failure");
  }
}

Exit run_verb(const Verb& verb, std::span<const std::string> arguments, Console& console) {
  const std::string name = fmt::format("limber {}", verb.name);
  CLI::App app(std::string(verb.summary), name);
  const Action action = verb.declare(app);
  console.conventions.threads = 0;
  declare_conventions(app, verb, console.conventions);
  std::vector<std::string> reversed(arguments.rbegin(), arguments.rend());  // as CLI11 wants them
  std::optional<std::string> complaint;
  try {
    app.parse(std::move(reversed));
  } catch (const CLI::CallForHelp&) {
    console.write_out(app.help());
    return Exit::kDone;
  } catch (const CLI::ParseError& error) {
    complaint = fmt::format("{}; see \"{} --help\"", error.what(), name);
  }
  // An option that is misspelt is worth more words than one that is missing for that reason.
  if (const std::vector<std::string> extras = app.remaining(); !extras.empty()) {
    const auto option = std::find_if(extras.begin(), extras.end(), [](const auto& e) { return e.starts_with('-'); });
    complaint = unexpected_argument(app, option != extras.end() ? *option : extras.front());
  }
  if (complaint) {
    console.conventions.json = std::find(arguments.begin(), arguments.end(), "--json") != arguments.end();
    return fail_usage(console, verb.name, *complaint);
  }
  if (console.conventions.threads == 0) console.conventions.threads = allowed_threads();
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, console.conventions.threads);
  return act(action, console, std::string(verb.name));
}

Exit dispatch(std::span<const std::string> arguments, Console& console) {
  if (arguments.empty()) {
    return fail_usage(console, "", "a verb is missing, such as \"build\" or \"info\"; \"limber --help\" lists them");
  }
  const std::string& first = arguments.front();
  if (first == "--help" || first == "-h" || (first == "help" && arguments.size() == 1)) {
    console.write_out(help_text());
    return Exit::kDone;
  }
  if (first == "--version" || first == "-V") {
    console.write_out(version_text());
    return Exit::kDone;
  }
  if (first == "help") {
    const std::vector<std::string> asked = {arguments[1], "--help"};
    return dispatch(asked, console);
  }
  if (const Verb* verb = find_verb(first)) return run_verb(*verb, arguments.subspan(1), console);
  console.conventions.json = std::find(arguments.begin(), arguments.end(), "--json") != arguments.end();
  if (first.starts_with('-'))
    return fail_usage(console, "", fmt::format("the verb comes first, before {}; see \"limber --help\"", first));
  return fail_usage(console, "", unknown_verb(first));
}

}  // namespace

Exit run_program(std::span<const std::string> arguments, Console& console) {
  const Exit exit = dispatch(arguments, console);
  const Result<void> flushed = console.flush();
  if (flushed || exit != Exit::kDone) return exit;
  console.conventions.json = false;  // what cannot be written
  return fail(console, flushed.error());
}

}  // namespace limber::tool
