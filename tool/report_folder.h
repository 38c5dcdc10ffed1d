// SPDX-License-Identifier: Apache-2.0
// A folder of files that are written all or none.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "limber/base/result.h"
#include "limber/clip/new_folders.h"
#include "limber/clip/output_file.h"

namespace limber::tool {

// Makes the folder where it is missing. What is destroyed before finish() leaves nothing behind, not even that.
class ReportFolder {
 public:
  // Errors: kExists where `path` is no folder, or one of the files is there and `replace` is false; those of
  // OutputFile.
  static Result<ReportFolder> create(const std::filesystem::path& path, std::vector<std::string> names, bool replace);

  // The whole of the file with this place among the names.
  Result<void> write(std::size_t file, std::string_view text);

  // One more file, whole. Errors: as of create().
  Result<void> add(const std::string& name, std::string_view text);

  // Gives all files their names. After an error none of the new ones is left where `replace` is false.
  Result<void> finish();

  std::filesystem::path path(std::size_t file) const { return files_[file].path(); }

 private:
  ReportFolder() = default;

  bool replace_ = false;
  std::filesystem::path folder_;
  NewFolders new_folders_;
  std::vector<OutputFile> files_;
};

}  // namespace limber::tool
