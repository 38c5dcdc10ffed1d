// SPDX-License-Identifier: Apache-2.0
// Errors as values. Wrong bytes and wrong files give a Result; a wrong call is an assert; a broken
// invariant is found by a validate() function that names it.
#pragma once

#include <cassert>
#include <optional>
#include <string>
#include <utility>

namespace limber {

enum class ErrorCode {
  kNotFound,     // no such file, folder, clip or verb argument
  kBadInput,     // bytes or text that break a rule of their format
  kTruncated,    // the data ends before it should: more bytes may mend it
  kUnsupported,  // well formed, but beyond what limber reads
  kMismatch,     // parts that do not fit each other (frames of different connectivity)
  kIo,           // the operating system refused to read or write
  kExists,       // an output is already there and may not be replaced
  kCancelled,    // the caller's progress function asked to stop
};

// One line for a person: `where` is the file and the place in it, `what` the rule broken and what to do.
struct Error {
  ErrorCode code = ErrorCode::kBadInput;
  std::string where;
  std::string what;

  std::string line() const { return where.empty() ? what : where + ": " + what; }
};

// Either a value or the error that prevented it.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : value_(std::move(value)) {}
  Result(Error error) : error_(std::move(error)) {}

  explicit operator bool() const { return value_.has_value(); }

  // Precondition of the next four: a value is there.
  T& operator*() { return assert(value_), *value_; }
  const T& operator*() const { return assert(value_), *value_; }
  T* operator->() { return assert(value_), &*value_; }
  const T* operator->() const { return assert(value_), &*value_; }

  // Precondition: no value is there.
  const Error& error() const { return assert(!value_), error_; }

 private:
  std::optional<T> value_;
  Error error_;
};

template <>
class [[nodiscard]] Result<void> {
 public:
  Result() = default;
  Result(Error error) : error_(std::move(error)) {}

  explicit operator bool() const { return !error_.has_value(); }
  const Error& error() const { return assert(error_), *error_; }

 private:
  std::optional<Error> error_;
};

}  // namespace limber
