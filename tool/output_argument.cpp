// SPDX-License-Identifier: Apache-2.0
#include "tool/output_argument.h"

namespace limber::tool {

void declare_output(CLI::App& app, OutputArgument& argument, const std::string& description, bool required) {
  app.add_option("-o,--output", argument.path, description)->type_name("OUTPUT")->required(required);
  app.add_flag("-f,--force", argument.replace, "replace an output that is already there");
}

}  // namespace limber::tool
