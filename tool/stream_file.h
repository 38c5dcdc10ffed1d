// SPDX-License-Identifier: Apache-2.0
// The bytes of a stream.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>

#include "limber/base/result.h"
#include "limber/stream/decoder.h"

namespace limber::tool {

// A file that is mapped into memory, so that no more of it is read than is looked at; "-" is standard input, read to
// its end. Streams are replaced as a whole, under another name first, so that a mapped one does not change.
class StreamFile {
 public:
  // Errors: kNotFound, kIo.
  static Result<StreamFile> open(const std::string& path);

  std::span<const std::byte> bytes() const { return bytes_; }
  // For messages.
  const std::string& name() const { return name_; }

 private:
  StreamFile() = default;

  std::string name_;
  std::shared_ptr<const void> owner_;
  std::span<const std::byte> bytes_;
};

// The error with the file's name before the place in it.
Error in_file(const std::string& name, const Error& error);

// Precondition: `file` outlives the decoder. Errors name the file.
Result<Decoder> open_decoder(const StreamFile& file);

}  // namespace limber::tool
