// SPDX-License-Identifier: Apache-2.0
// Files that are read: whole, or piece by piece at any offset.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>

#include "limber/base/result.h"

namespace limber {

// The extension with its dot, in lower case.
std::string lower_case_extension(const std::filesystem::path& path);

// Errors name the file. kNotFound: no such file; kIo: a folder or device, or the system refuses.
class InputFile {
 public:
  static Result<InputFile> open(const std::filesystem::path& path);

  // In bytes, when the file was opened.
  std::uint64_t size() const { return size_; }
  const std::string& name() const { return name_; }

  // Fills `bytes` from `offset` on; kTruncated where the file ends before.
  Result<void> read(std::uint64_t offset, std::span<char> bytes);

 private:
  InputFile() = default;

  std::ifstream stream_;
  std::string name_;
  std::uint64_t size_ = 0;
};

// Replaces `bytes` by those of the file, in the memory that it has where that suffices.
Result<void> read_file(const std::filesystem::path& path, std::string& bytes);

}  // namespace limber
