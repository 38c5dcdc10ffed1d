// SPDX-License-Identifier: Apache-2.0
// Files that are written whole or not at all.
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <span>
#include <string_view>

#include "limber/base/result.h"

namespace limber {

// Writes to a hidden temporary file beside the final name. commit() gives it the final name in one step; a file that
// is destroyed before leaves nothing behind, and leaves what was there as it was. Whoever opens the final name sees
// the old file or the new one, whole. (After a power failure this holds as far as the file system promises it.)
//
// A symbolic link is followed: its target is replaced. A device or pipe (/dev/stdout) cannot be replaced and is
// written directly.
class OutputFile {
 public:
  // Errors: kExists where there is a file and `replace` is false; kNotFound where the folder is missing; kIo.
  static Result<OutputFile> create(const std::filesystem::path& path, bool replace);

  // What is written goes to standard output directly, under the name "standard output".
  static Result<OutputFile> standard_output();

  OutputFile(OutputFile&& other) noexcept;
  OutputFile& operator=(OutputFile&& other) noexcept;
  ~OutputFile();

  // Appends. After an error of any of these functions the file can only be destroyed.
  Result<void> write(std::span<const char> bytes);

  // Replaces bytes that are written already, for headers that are known last.
  Result<void> write_at(std::uint64_t offset, std::span<const char> bytes);

  // Reads back bytes that are written already.
  Result<void> read_at(std::uint64_t offset, std::span<char> bytes);

  // The bytes written so far.
  std::uint64_t size() const { return size_; }

  // The final name.
  const std::filesystem::path& path() const { return path_; }

  // Hands all bytes to the system, so that no open file is held until commit(). Only commit() may follow.
  Result<void> close();

  // close(), and the final name. Nothing may follow.
  Result<void> commit();

  // Removes what was written, as destruction does. Nothing may follow.
  void discard();

 private:
  struct Closer {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  OutputFile() = default;
  Error system_error(std::string_view what) const;

  std::unique_ptr<std::FILE, Closer> file_;
  std::filesystem::path path_;
  std::filesystem::path target_;     // path_ with symbolic links followed
  std::filesystem::path temporary_;  // empty: written directly, or nothing to remove any more
  std::uint64_t size_ = 0;
  bool replace_ = false;
};

// Commits all of them. After an error none of the new files is left where `replace` is false, what they were created
// with.
Result<void> commit_all(std::span<OutputFile> files, bool replace);

}  // namespace limber
