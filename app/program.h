// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/options/command.h"

namespace afm::app {

// First lines of the program's help: its name and purpose, then the exit codes.
inline constexpr const char* kProgramHelp =
    "TouchAFM: feel and see the approach-retract cycle of an atomic force microscope.\n"
    "Exit codes: 0 done, 1 the run failed or was interrupted, 2 wrong usage, 3 bad input file, 4 a required device is "
    "missing.";

// The whole program, called by main(). Returns its exit code. `commit` is printed by --version.
int run_program(int count, char** arguments, const char* commit);

// Adds all of kCommands. The context must outlive the command line.
inline void add_commands(CommandLine& program, const CommandContext& context) {
  for (const Command& command : kCommands) command.add(program, context);
}

}  // namespace afm::app
