// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <string>
#include <vector>

#include "tool/console.h"
#include "tool/interrupt.h"
#include "tool/program.h"

int main(int argc, char** argv) {
  limber::tool::handle_signals();
  limber::tool::Console console(stdout, stderr);
  const std::vector<std::string> arguments(argv + (argc > 0 ? 1 : 0), argv + argc);
  return static_cast<int>(limber::tool::run_program(arguments, console));
}
