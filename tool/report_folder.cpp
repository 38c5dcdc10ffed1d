// SPDX-License-Identifier: Apache-2.0
#include "tool/report_folder.h"

#include <algorithm>
#include <fmt/format.h>
#include <span>
#include <system_error>

namespace limber::tool {
namespace {

namespace fs = std::filesystem;

}  // namespace

Result<ReportFolder> ReportFolder::create(const fs::path& path, std::vector<std::string> names, bool replace) {
  ReportFolder folder;
  folder.replace_ = replace;
  std::error_code error;
  // "report/" has an empty last part.
  const fs::path wanted = path.has_filename() ? path : path.parent_path();
  for (fs::path at = wanted; !at.empty() && !fs::exists(at, error); at = at.parent_path())
    folder.made_folders_.insert(folder.made_folders_.begin(), at);
  if (folder.made_folders_.empty() && !fs::is_directory(wanted, error))
    return Error{ErrorCode::kExists, path.string(), "is a file; a report needs a folder"};
  for (std::size_t i = 0; i < folder.made_folders_.size(); ++i) {
    if (fs::create_directory(folder.made_folders_[i], error)) continue;
    const Error refused{ErrorCode::kIo, folder.made_folders_[i].string(),
                        fmt::format("cannot be made: {}", error.message())};
    folder.made_folders_.resize(i);
    return refused;
  }
  folder.folder_ = wanted;
  for (const std::string& name : names) {
    Result<OutputFile> file = OutputFile::create(wanted / name, replace);
    if (!file) return file.error();
    folder.files_.push_back(std::move(*file));
  }
  return folder;
}

ReportFolder::~ReportFolder() {
  files_.clear();
  std::error_code ignored;
  // Only empty folders can be removed this way.
  for (auto made = made_folders_.rbegin(); made != made_folders_.rend(); ++made) fs::remove(*made, ignored);
}

Result<void> ReportFolder::write(std::size_t file, std::string_view text) {
  if (Result<void> written = files_[file].write({text.data(), text.size()}); !written) return written;
  return files_[file].close();
}

Result<void> ReportFolder::add(const std::string& name, std::string_view text) {
  Result<OutputFile> file = OutputFile::create(folder_ / name, replace_);
  if (!file) return file.error();
  files_.push_back(std::move(*file));
  return write(files_.size() - 1, text);
}

Result<void> ReportFolder::finish() {
  for (std::size_t i = 0; i < files_.size(); ++i) {
    Result<void> done = files_[i].commit();
    if (done) continue;
    std::error_code ignored;
    for (std::size_t j = 0; j < i && !replace_; ++j) fs::remove(files_[j].path(), ignored);
    return done;
  }
  return {};
}

}  // namespace limber::tool
