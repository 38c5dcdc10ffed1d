// SPDX-License-Identifier: Apache-2.0
// SIGINT and SIGTERM: long work asks whether it should stop, and then ends by itself, so that nothing is left behind.
#pragma once

namespace limber::tool {

// From now on both signals are noted, and SIGPIPE is ignored: writing to a closed pipe is an error like others.
void handle_signals();

// Has one of them come?
bool interrupted();

}  // namespace limber::tool
