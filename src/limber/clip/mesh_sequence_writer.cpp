// SPDX-License-Identifier: Apache-2.0
#include "limber/clip/mesh_sequence_writer.h"

#include <utility>

namespace limber {

Result<MeshSequenceWriter> MeshSequenceWriter::create(const std::filesystem::path& pattern, std::uint32_t first_number,
                                                      const MeshWriteOptions& options) {
  const std::optional<MeshFormat> format = mesh_format(pattern);
  if (!format) {
    return Error{ErrorCode::kUnsupported, pattern.string(), "frames are written as .obj, .ply or .off files"};
  }
  Result<OutputSequence> files = OutputSequence::create(pattern, first_number, options.replace);
  if (!files) return files.error();
  return MeshSequenceWriter(std::move(*files), *format, options);
}

Result<void> MeshSequenceWriter::write(const MeshParts& mesh) {
  Result<OutputFile*> file = files_.next();
  if (!file) return file.error();
  return write_mesh(**file, format_, mesh, options_);
}

}  // namespace limber
