// SPDX-License-Identifier: Apache-2.0
// The arguments by which all verbs take an output.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "limber/clip/mesh_sequence_writer.h"
#include "tool/console.h"

namespace limber::tool {

struct OutputArgument {
  std::string path;
  bool replace = false;

  MeshFormat format = MeshFormat::kObj;  // of meshes to standard output

  bool is_standard_output() const { return path == "-"; }
};

// -o and -f. `argument` must outlive the parsing.
void declare_output(CLI::App& app, OutputArgument& argument, const std::string& description, bool required = true);

// The same for meshes, in files or, one of them, on standard output; and --format, which says as what.
void declare_mesh_output(CLI::App& app, OutputArgument& argument, const std::string& description);

// Where meshes go, the first of them with this number. With `-o -` the results go to standard error: UsageError with
// --json. Errors: those of MeshSequenceWriter.
Result<MeshSequenceWriter> open_mesh_output(const OutputArgument& argument, std::uint32_t first_number,
                                            Console& console);

}  // namespace limber::tool
