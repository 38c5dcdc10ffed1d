// SPDX-License-Identifier: Apache-2.0
#include "limber/clip/output_sequence.h"

#include <fmt/format.h>
#include <system_error>

namespace limber {
namespace {

namespace fs = std::filesystem;

}  // namespace

Result<OutputSequence> OutputSequence::create(const fs::path& pattern, std::uint32_t first_number, bool replace) {
  OutputSequence sequence;
  sequence.folder_ = pattern.parent_path();
  sequence.next_number_ = first_number;
  sequence.replace_ = replace;
  const std::string file_name = pattern.filename().string();
  sequence.single_ = !NumberedName::is_pattern(file_name);
  if (sequence.single_) {
    sequence.name_.prefix = file_name;
  } else {
    Result<NumberedName> name = NumberedName::parse(file_name);
    if (!name) return name.error();
    sequence.name_ = *name;
  }
  std::error_code ignored;
  if (!replace) {
    const fs::path folder = sequence.folder_.empty() ? fs::path(".") : sequence.folder_;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
      const std::string name = entry.path().filename().string();
      if (sequence.single_ ? name != file_name : !sequence.name_.number(name)) continue;
      return Error{ErrorCode::kExists, (sequence.folder_ / name).string(), "is already there; use -f to replace it"};
    }
  }
  if (Result<void> done = sequence.new_folders_.make(sequence.folder_); !done) return done.error();
  return sequence;
}

OutputSequence OutputSequence::standard_output() {
  OutputSequence sequence;
  sequence.single_ = sequence.is_standard_output_ = true;
  sequence.name_.prefix = "standard output";
  return sequence;
}

Result<OutputFile*> OutputSequence::next() {
  if (!files_.empty()) {
    if (single_) {
      return Error{ErrorCode::kBadInput, files_.back().path().string(),
                   "a file holds one frame; put a number into the name for more: frame%04d.obj"};
    }
    if (Result<void> done = files_.back().close(); !done) return done.error();
  }
  const fs::path path = folder_ / (single_ ? name_.prefix : name_.name(next_number_++));
  Result<OutputFile> file = is_standard_output_ ? OutputFile::standard_output() : OutputFile::create(path, replace_);
  if (!file) return file.error();
  files_.push_back(std::move(*file));
  return &files_.back();
}

Result<void> OutputSequence::finish() {
  if (files_.empty()) {
    return Error{ErrorCode::kBadInput, (folder_ / (single_ ? name_.prefix : name_.name(next_number_))).string(),
                 "there are no frames to write"};
  }
  return commit_all(files_, replace_);
}

}  // namespace limber
