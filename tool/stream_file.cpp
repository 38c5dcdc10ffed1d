// SPDX-License-Identifier: Apache-2.0
#include "tool/stream_file.h"

#include <cerrno>
#include <cstdio>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <vector>

namespace limber::tool {
namespace {

Error system_error(const std::string& name) {
  const int error = errno != 0 ? errno : EIO;
  if (error == ENOENT) return {ErrorCode::kNotFound, name, "no such file"};
  return {ErrorCode::kIo, name, fmt::format("cannot be read: {}", std::generic_category().message(error))};
}

// To the end: pipes have no size.
Result<std::shared_ptr<std::vector<std::byte>>> read_all(int file, const std::string& name) {
  const auto bytes = std::make_shared<std::vector<std::byte>>();
  std::size_t size = 0;
  for (;;) {
    if (bytes->size() - size < 65536) bytes->resize(2 * size + 65536);
    errno = 0;
    const ssize_t got = ::read(file, bytes->data() + size, bytes->size() - size);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return system_error(name);
    if (got == 0) break;
    size += static_cast<std::size_t>(got);
  }
  bytes->resize(size);
  return bytes;
}

struct Descriptor {
  int number;
  ~Descriptor() {
    if (number > STDERR_FILENO) ::close(number);
  }
};

}  // namespace

Result<StreamFile> StreamFile::open(const std::string& path) {
  StreamFile file;
  file.name_ = path == "-" ? "standard input" : path;
  errno = 0;
  const Descriptor descriptor{path == "-" ? STDIN_FILENO : ::open(path.c_str(), O_RDONLY | O_CLOEXEC)};
  struct stat status = {};
  if (descriptor.number < 0 || ::fstat(descriptor.number, &status) != 0) return system_error(file.name_);
  if (S_ISDIR(status.st_mode)) return Error{ErrorCode::kBadInput, file.name_, "is a folder, not a stream"};
  if (S_ISREG(status.st_mode) && status.st_size > 0 && path != "-") {
    const auto size = static_cast<std::size_t>(status.st_size);
    void* const start = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, descriptor.number, 0);
    if (start == MAP_FAILED) return system_error(file.name_);
    file.owner_ = std::shared_ptr<const void>(start, [start, size](const void*) { ::munmap(start, size); });
    file.bytes_ = {static_cast<const std::byte*>(start), size};
    return file;
  }
  auto bytes = read_all(descriptor.number, file.name_);
  if (!bytes) return bytes.error();
  file.bytes_ = **bytes;
  file.owner_ = std::move(*bytes);
  return file;
}

Error in_file(const std::string& name, const Error& error) {
  return {error.code, error.where.empty() ? name : fmt::format("{}: {}", name, error.where), error.what};
}

Result<Decoder> open_decoder(const StreamFile& file) {
  Decoder decoder;
  if (Result<void> opened = decoder.open(file.bytes()); !opened) return in_file(file.name(), opened.error());
  return decoder;
}

}  // namespace limber::tool
