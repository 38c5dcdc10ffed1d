// SPDX-License-Identifier: Apache-2.0
// Numbered files that are written all or none.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

#include "limber/base/result.h"
#include "limber/clip/new_folders.h"
#include "limber/clip/numbered_name.h"
#include "limber/clip/output_file.h"

namespace limber {

// Every file is an OutputFile; finish() gives all of them their names. A sequence that is destroyed before leaves
// nothing behind. The folder of the files is made where it is missing.
class OutputSequence {
 public:
  // `pattern` is a path whose file name is a NumberedName pattern, or names a single file. Errors: those of
  // OutputFile and NumberedName; kExists, too, where any file fits the pattern and `replace` is false, so that no old
  // frames mix with the new. With `replace`, files are replaced one by one, and others that fit the pattern stay.
  static Result<OutputSequence> create(const std::filesystem::path& pattern, std::uint32_t first_number, bool replace);

  // A single file: standard output.
  static OutputSequence standard_output();

  // Closes the file before and begins the next; the pointer is valid until the next call. kBadInput for a second
  // file where the pattern has no number.
  Result<OutputFile*> next();

  // kBadInput where there are no files. After an error nothing is left where `replace` is false.
  Result<void> finish();

 private:
  OutputSequence() = default;

  std::filesystem::path folder_;
  NumberedName name_;
  bool single_ = false;
  bool is_standard_output_ = false;
  std::uint64_t next_number_ = 0;
  bool replace_ = false;
  NewFolders new_folders_;
  std::vector<OutputFile> files_;
};

}  // namespace limber
