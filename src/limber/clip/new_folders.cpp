// SPDX-License-Identifier: Apache-2.0
#include "limber/clip/new_folders.h"

#include <fmt/format.h>
#include <system_error>

namespace limber {

namespace fs = std::filesystem;

NewFolders::~NewFolders() {
  std::error_code ignored;
  // Only empty folders can be removed this way.
  for (auto folder = made_.rbegin(); folder != made_.rend(); ++folder) fs::remove(*folder, ignored);
}

Result<void> NewFolders::make(const fs::path& folder) {
  std::error_code error;
  if (folder.empty() || fs::is_directory(folder, error)) return {};
  if (Result<void> done = make(folder.parent_path()); !done) return done;
  if (fs::create_directory(folder, error)) made_.push_back(folder);
  if (error) return Error{ErrorCode::kIo, folder.string(), fmt::format("cannot be made: {}", error.message())};
  return {};
}

}  // namespace limber
