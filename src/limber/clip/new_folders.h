// SPDX-License-Identifier: Apache-2.0
// Folders that are made for files, and go again where none came to stay.
#pragma once

#include <filesystem>
#include <vector>

#include "limber/base/result.h"

namespace limber {

// On destruction those that it made and that are empty are removed. What writes into them must be destroyed before.
class NewFolders {
 public:
  NewFolders() = default;
  NewFolders(NewFolders&&) = default;
  NewFolders& operator=(NewFolders&&) = delete;
  ~NewFolders();

  // Makes `folder` and those above it that are missing. Error: kIo.
  Result<void> make(const std::filesystem::path& folder);

 private:
  std::vector<std::filesystem::path> made_;  // outermost first
};

}  // namespace limber
