// SPDX-License-Identifier: Apache-2.0
// What the program tells the shell.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

#include "limber/base/result.h"

namespace limber::tool {

enum class Exit : int {
  kDone = 0,
  kFailure = 1,       // the system refused, or an output is already there
  kUsage = 2,         // the command line makes no sense
  kBadInput = 3,      // an input is missing, broken, or does not fit
  kCheckFailed = 4,   // `check` found something
  kInterrupted = 130  // SIGINT or SIGTERM
};

// The one place where errors of the library become exit codes.
Exit exit_for(ErrorCode code);

// The name of an error in JSON: "not-found".
std::string_view name_of(ErrorCode code);

// Arguments that are well formed one by one but make no sense together. Thrown by verbs before they do anything; the
// only exception that verbs throw.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace limber::tool
