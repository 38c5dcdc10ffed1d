// SPDX-License-Identifier: Apache-2.0
#include "limber/clip/output_file.h"

#include <cerrno>
#include <fcntl.h>
#include <fmt/format.h>
#include <random>
#include <string>
#include <sys/types.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace limber {
namespace {

namespace fs = std::filesystem;

Error already_there(const fs::path& path) {
  return {ErrorCode::kExists, path.string(), "is already there; use -f to replace it"};
}

std::string reason(int error) { return std::generic_category().message(error != 0 ? error : EIO); }

// Hidden, and with an ending that no reader of clips takes for a frame.
fs::path temporary_name(const fs::path& target) {
  std::random_device random;
  return target.parent_path() / fmt::format(".{}.{:08x}.part", target.filename().string(), random());
}

bool seek(std::FILE* file, std::uint64_t offset) {
  static_assert(sizeof(off_t) == 8, "files may be larger than 4 GB");
  return fseeko(file, static_cast<off_t>(offset), SEEK_SET) == 0;
}

}  // namespace

Result<OutputFile> OutputFile::create(const fs::path& path, bool replace) {
  OutputFile output;
  output.path_ = path;
  output.target_ = path;
  output.replace_ = replace;
  std::error_code ignored;
  if (fs::is_symlink(path, ignored)) {
    std::error_code error;
    output.target_ = fs::weakly_canonical(path, error);
    if (error) return Error{ErrorCode::kIo, path.string(), fmt::format("cannot be followed: {}", error.message())};
  }
  const fs::file_status status = fs::status(path, ignored);
  if (fs::is_directory(status)) return Error{ErrorCode::kExists, path.string(), "is a folder, not a file to write"};
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    output.file_.reset(std::fopen(path.c_str(), "wb"));
    if (!output.file_) return output.system_error("cannot be opened");
    return output;
  }
  if (fs::exists(status) && !replace) return already_there(path);
  const fs::path folder = output.target_.parent_path();
  if (!folder.empty() && !fs::is_directory(folder, ignored)) {
    return Error{ErrorCode::kNotFound, path.string(),
                 fmt::format("there is no folder {} to write to", folder.string())};
  }
  do {
    output.temporary_ = temporary_name(output.target_);
    errno = 0;
    output.file_.reset(std::fopen(output.temporary_.c_str(), "w+bx"));
  } while (!output.file_ && errno == EEXIST);
  if (!output.file_) {
    output.temporary_.clear();
    return output.system_error("cannot be created");
  }
  if (fs::exists(status)) fs::permissions(output.temporary_, status.permissions(), ignored);
  return output;
}

Result<OutputFile> OutputFile::standard_output() {
  OutputFile output;
  output.path_ = output.target_ = "standard output";
  std::fflush(stdout);
  errno = 0;
  // A copy, so that closing it, which finds out whether all could be written, leaves the process its own.
  const int copy = fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 0);
  if (copy >= 0) output.file_.reset(fdopen(copy, "wb"));
  if (!output.file_) return output.system_error("cannot be opened");
  return output;
}

OutputFile::OutputFile(OutputFile&& other) noexcept
    : file_(std::move(other.file_)),
      path_(std::move(other.path_)),
      target_(std::move(other.target_)),
      temporary_(std::exchange(other.temporary_, {})),
      size_(other.size_),
      replace_(other.replace_) {}

OutputFile& OutputFile::operator=(OutputFile&& other) noexcept {
  if (this == &other) return *this;
  discard();
  file_ = std::move(other.file_);
  path_ = std::move(other.path_);
  target_ = std::move(other.target_);
  temporary_ = std::exchange(other.temporary_, {});
  size_ = other.size_;
  replace_ = other.replace_;
  return *this;
}

OutputFile::~OutputFile() { discard(); }

void OutputFile::discard() {
  file_.reset();
  if (temporary_.empty()) return;
  std::error_code ignored;
  fs::remove(temporary_, ignored);
  temporary_.clear();
}

Error OutputFile::system_error(std::string_view what) const {
  return {ErrorCode::kIo, path_.string(), fmt::format("{}: {}", what, reason(errno))};
}

Result<void> OutputFile::write(std::span<const char> bytes) {
  assert(file_);
  errno = 0;
  if (std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size()) return system_error("cannot be written");
  size_ += bytes.size();
  return {};
}

Result<void> OutputFile::write_at(std::uint64_t offset, std::span<const char> bytes) {
  assert(file_ && offset + bytes.size() <= size_);
  errno = 0;
  if (!seek(file_.get(), offset) || std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size() ||
      !seek(file_.get(), size_)) {
    return system_error("cannot be written");
  }
  return {};
}

Result<void> OutputFile::read_at(std::uint64_t offset, std::span<char> bytes) {
  assert(file_ && offset + bytes.size() <= size_);
  errno = 0;
  if (!seek(file_.get(), offset) || std::fread(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size() ||
      !seek(file_.get(), size_)) {
    return system_error("cannot be read back");
  }
  return {};
}

Result<void> OutputFile::close() {
  if (!file_) return {};
  errno = 0;
  if (std::fclose(file_.release()) != 0) return system_error("cannot be written");
  return {};
}

Result<void> OutputFile::commit() {
  if (Result<void> done = close(); !done) return done;
  if (temporary_.empty()) return {};
  std::error_code error;
  // Somebody else may have written it since create().
  if (!replace_ && fs::exists(target_, error)) return already_there(path_);
  fs::rename(temporary_, target_, error);
  if (error) return Error{ErrorCode::kIo, path_.string(), fmt::format("cannot be given its name: {}", error.message())};
  temporary_.clear();
  return {};
}

Result<void> commit_all(std::span<OutputFile> files, bool replace) {
  for (std::size_t i = 0; i < files.size(); ++i) {
    Result<void> done = files[i].commit();
    if (done) continue;
    std::error_code ignored;
    for (std::size_t j = 0; j < i && !replace; ++j) std::filesystem::remove(files[j].path(), ignored);
    return done;
  }
  return {};
}

}  // namespace limber
