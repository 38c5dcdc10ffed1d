// SPDX-License-Identifier: Apache-2.0
#include "limber/clip/input_file.h"

#include <algorithm>
#include <cerrno>
#include <fmt/format.h>
#include <system_error>

namespace limber {

std::string lower_case_extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return extension;
}

Result<InputFile> InputFile::open(const std::filesystem::path& path) {
  InputFile file;
  file.name_ = path.string();
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) {
    const bool missing = status.type() == std::filesystem::file_type::not_found;
    return Error{missing ? ErrorCode::kNotFound : ErrorCode::kIo, file.name_,
                 missing ? "no such file" : error.message()};
  }
  if (!std::filesystem::is_regular_file(status)) return Error{ErrorCode::kIo, file.name_, "is not a file"};
  file.size_ = std::filesystem::file_size(path, error);
  errno = 0;
  file.stream_.open(path, std::ios::binary);
  if (error || !file.stream_) {
    const int reason = errno != 0 ? errno : EIO;
    return Error{
        ErrorCode::kIo, file.name_,
        fmt::format("cannot be opened: {}", error ? error.message() : std::generic_category().message(reason))};
  }
  return file;
}

Result<void> InputFile::read(std::uint64_t offset, std::span<char> bytes) {
  stream_.clear();
  stream_.seekg(static_cast<std::streamoff>(offset));
  stream_.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (stream_) return {};
  const std::uint64_t stop = offset + static_cast<std::uint64_t>(std::max<std::streamsize>(0, stream_.gcount()));
  const std::string where = fmt::format("{}, byte {}", name_, stop);
  if (stream_.eof()) return Error{ErrorCode::kTruncated, where, "the file ends here, before its data do"};
  return Error{ErrorCode::kIo, where, "cannot be read"};
}

Result<void> read_file(const std::filesystem::path& path, std::string& bytes) {
  Result<InputFile> file = InputFile::open(path);
  if (!file) return file.error();
  bytes.resize(file->size());
  return file->read(0, bytes);
}

}  // namespace limber
