// SPDX-License-Identifier: Apache-2.0
#include "tool/report_folder.h"

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
  if (fs::exists(wanted, error) && !fs::is_directory(wanted, error))
    return Error{ErrorCode::kExists, path.string(), "is a file; a report needs a folder"};
  if (Result<void> made = folder.new_folders_.make(wanted); !made) return made.error();
  folder.folder_ = wanted;
  for (const std::string& name : names) {
    Result<OutputFile> file = OutputFile::create(wanted / name, replace);
    if (!file) return file.error();
    folder.files_.push_back(std::move(*file));
  }
  return folder;
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

Result<void> ReportFolder::finish() { return commit_all(files_, replace_); }

}  // namespace limber::tool
