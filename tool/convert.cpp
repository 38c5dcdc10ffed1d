// SPDX-License-Identifier: Apache-2.0
#include <vector>

#include "tool/clip_argument.h"
#include "tool/copy_clip.h"
#include "tool/output_argument.h"
#include "tool/verb.h"

namespace limber::tool {
namespace {

struct Arguments {
  ClipArgument clip;
  OutputArgument output;
};

Result<Exit> convert(const Arguments& arguments, Console& console) {
  auto reader = open_any_clip(arguments.clip);
  if (!reader) return reader.error();
  return copy_clip(**reader, arguments.output, "limber.convert/1", console);
}

}  // namespace

Action declare_convert(CLI::App& app) {
  const auto arguments = std::make_shared<Arguments>();
  declare_clip(app, arguments->clip);
  declare_output(app, arguments->output, "'out/%04d.obj' (or .ply, .off), out.pc2 or out.mdd (with out.obj beside it)");
  return [arguments](Console& console) { return convert(*arguments, console); };
}

}  // namespace limber::tool
