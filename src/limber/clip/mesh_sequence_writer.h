// SPDX-License-Identifier: Apache-2.0
// A mesh file per frame, all or none. The connectivity may change from frame to frame.
#pragma once

#include <cstdint>
#include <filesystem>

#include "limber/base/result.h"
#include "limber/clip/mesh_file.h"
#include "limber/clip/output_sequence.h"

namespace limber {

class MeshSequenceWriter {
 public:
  // `pattern` as OutputSequence; its extension gives the format. Errors: those of OutputSequence, and kUnsupported
  // for an unknown extension.
  static Result<MeshSequenceWriter> create(const std::filesystem::path& pattern, std::uint32_t first_number,
                                           const MeshWriteOptions& options = {});

  // A single mesh to standard output.
  static MeshSequenceWriter to_standard_output(MeshFormat format) {
    return MeshSequenceWriter(OutputSequence::standard_output(), format, {});
  }

  Result<void> write(const MeshParts& mesh);
  Result<void> finish() { return files_.finish(); }

 private:
  MeshSequenceWriter(OutputSequence files, MeshFormat format, const MeshWriteOptions& options)
      : files_(std::move(files)), format_(format), options_(options) {}

  OutputSequence files_;
  MeshFormat format_;
  MeshWriteOptions options_;
};

}  // namespace limber
