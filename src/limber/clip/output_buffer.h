// SPDX-License-Identifier: Apache-2.0
// Bytes, and numbers as text, into a file in large pieces.
#pragma once

#include <charconv>
#include <cstdint>
#include <string>
#include <string_view>

#include "limber/base/result.h"
#include "limber/base/vec.h"
#include "limber/clip/output_file.h"

namespace limber {

// Numbers become the shortest text that reads back the same. The first error is kept, and given by finish().
class OutputBuffer {
 public:
  explicit OutputBuffer(OutputFile& file) : file_(file) { buffer_.reserve(kFlushSize + 256); }

  OutputBuffer& append(std::string_view bytes) {
    buffer_ += bytes;
    if (buffer_.size() >= kFlushSize) flush();
    return *this;
  }

  OutputBuffer& append_integer(std::uint64_t value) { return append_number(value); }
  OutputBuffer& append_vector(const Vec3f& v) {
    return append_number(v.x).append(" ").append_number(v.y).append(" ").append_number(v.z);
  }

  // Hands over what is left.
  Result<void> finish() {
    flush();
    return status_;
  }

 private:
  static constexpr std::size_t kFlushSize = 1 << 16;

  template <class T>
  OutputBuffer& append_number(T value) {
    char digits[32];
    const std::to_chars_result end = std::to_chars(digits, digits + sizeof digits, value);
    return append({digits, static_cast<std::size_t>(end.ptr - digits)});
  }

  void flush() {
    if (status_) status_ = file_.write(buffer_);
    buffer_.clear();
  }

  OutputFile& file_;
  std::string buffer_;
  Result<void> status_;
};

}  // namespace limber
