// SPDX-License-Identifier: Apache-2.0
#include "tool/exit.h"

namespace limber::tool {

Exit exit_for(ErrorCode code) {
  switch (code) {
    case ErrorCode::kNotFound:
    case ErrorCode::kBadInput:
    case ErrorCode::kTruncated:
    case ErrorCode::kUnsupported:
    case ErrorCode::kMismatch:
      return Exit::kBadInput;
    case ErrorCode::kIo:
    case ErrorCode::kExists:
      return Exit::kFailure;
    case ErrorCode::kCancelled:
      return Exit::kInterrupted;
  }
  return Exit::kFailure;
}

std::string_view name_of(ErrorCode code) {
  switch (code) {
    case ErrorCode::kNotFound:
      return "not-found";
    case ErrorCode::kBadInput:
      return "bad-input";
    case ErrorCode::kTruncated:
      return "truncated";
    case ErrorCode::kUnsupported:
      return "unsupported";
    case ErrorCode::kMismatch:
      return "mismatch";
    case ErrorCode::kIo:
      return "io";
    case ErrorCode::kExists:
      return "exists";
    case ErrorCode::kCancelled:
      return "interrupted";
  }
  return "failure";
}

}  // namespace limber::tool
