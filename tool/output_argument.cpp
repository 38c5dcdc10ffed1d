// SPDX-License-Identifier: Apache-2.0
#include "tool/output_argument.h"

#include <map>

#include "tool/exit.h"

namespace limber::tool {

void declare_output(CLI::App& app, OutputArgument& argument, const std::string& description, bool required) {
  app.add_option("-o,--output", argument.path, description)->type_name("OUTPUT")->required(required);
  app.add_flag("-f,--force", argument.replace, "replace an output that is already there");
}

void declare_mesh_output(CLI::App& app, OutputArgument& argument, const std::string& description) {
  declare_output(app, argument, description, false);
  static const std::map<std::string, MeshFormat> kFormats = {
      {"obj", MeshFormat::kObj}, {"ply", MeshFormat::kPly}, {"off", MeshFormat::kOff}};
  app.add_option("--format", argument.format, "what a mesh is written as to standard output (obj)")
      ->transform(CLI::CheckedTransformer(kFormats, CLI::ignore_case).description(""))
      ->type_name("obj|ply|off");
}

Result<MeshSequenceWriter> open_mesh_output(const OutputArgument& argument, std::uint32_t first_number,
                                            Console& console) {
  if (!argument.is_standard_output())
    return MeshSequenceWriter::create(argument.path, first_number, {.replace = argument.replace});
  if (console.conventions.json) throw UsageError("-o - and --json both want standard output; give one of them up");
  console.results_go_to_standard_error();
  return MeshSequenceWriter::to_standard_output(argument.format);
}

}  // namespace limber::tool
