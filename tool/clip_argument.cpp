// SPDX-License-Identifier: Apache-2.0
#include "tool/clip_argument.h"

namespace limber::tool {

void declare_clip(CLI::App& app, ClipArgument& argument, const std::string& name) {
  app.add_option(name, argument.specification,
                 "a pattern ('horse/%04d.obj'), quoted glob or folder of .obj, .ply or .off frames; a .pc2 or .mdd; "
                 "a .limber stream; a generated sample ('sample:gallop?vertices=5000&frames=24'); or a single mesh")
      ->required();
  app.add_option("--mesh", argument.options.mesh,
                 "the mesh of a .pc2 or .mdd; found by itself where it is the only one")
      ->type_name("FILE");
  app.add_option("--first", argument.options.first, "first frame, as the source numbers them")->type_name("N");
  app.add_option("--last", argument.options.last, "last frame, as the source numbers them")->type_name("N");
}

Result<std::unique_ptr<ClipReader>> open_any_clip(const ClipArgument& argument) {
  return open_clip(argument.specification, argument.options);
}

}  // namespace limber::tool
