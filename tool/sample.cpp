// SPDX-License-Identifier: Apache-2.0
#include "limber/clip/sample.h"

#include <algorithm>
#include <string>
#include <vector>

#include "tool/copy_clip.h"
#include "tool/output_argument.h"
#include "tool/ranges.h"
#include "tool/suggest.h"
#include "tool/verb.h"

namespace limber::tool {
namespace {

struct Arguments {
  std::string name;
  OutputArgument output;
  std::uint32_t vertex_count = 10000;
  std::uint32_t frame_count = 60;
};

Exit list_samples(Console& console) {
  Json list = Json::array();
  for (const SampleInfo& sample : samples()) {
    console.print("{:<10} {}\n", sample.name, sample.description);
    list.push_back({{"name", sample.name}, {"description", sample.description}});
  }
  console.report("limber.samples/1", {{"samples", list}});
  return Exit::kDone;
}

Result<Exit> sample(const Arguments& arguments, Console& console) {
  if (arguments.name.empty()) return list_samples(console);
  std::vector<std::string> names;
  for (const SampleInfo& info : samples()) names.emplace_back(info.name);
  if (std::find(names.begin(), names.end(), arguments.name) == names.end()) {
    const std::string meant = nearest(arguments.name, names);
    throw UsageError(fmt::format("there is no sample \"{}\"; {}\"limber sample\" lists them", arguments.name,
                                 meant.empty() ? "" : fmt::format("did you mean \"{}\"? ", meant)));
  }
  if (arguments.output.path.empty()) throw UsageError("-o is missing: where should the frames go?");
  auto reader = open_sample(
      fmt::format("sample:{}?vertices={}&frames={}", arguments.name, arguments.vertex_count, arguments.frame_count));
  if (!reader) return reader.error();
  return copy_clip(**reader, arguments.output, "limber.sample/1", console);
}

}  // namespace

Action declare_sample(CLI::App& app) {
  const auto arguments = std::make_shared<Arguments>();
  app.add_option("NAME", arguments->name, "the sample; without it, the samples are listed");
  app.add_option("--vertices", arguments->vertex_count, "its vertices")
      ->check(in_range(100, 5000000))
      ->type_name("N")
      ->capture_default_str();
  app.add_option("--frames", arguments->frame_count, "its frames")
      ->check(in_range(1, 100000))
      ->type_name("N")
      ->capture_default_str();
  declare_output(app, arguments->output, "'out/%04d.obj' (or .ply, .off), out.pc2 or out.mdd (with out.obj beside it)",
                 false);
  return [arguments](Console& console) { return sample(*arguments, console); };
}

}  // namespace limber::tool
