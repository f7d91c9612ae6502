// SPDX-License-Identifier: MIT
/// \file
/// Runs another program and waits until it ends.
#pragma once

#include <string>
#include <vector>

namespace risorius::report {

struct ProgramResult {
    int exit_code = 0;   ///< 127: the program does not exist
    std::string output;  ///< what the program wrote to standard output and standard error
};

/// Runs a command without a shell; `command[0]` is searched for in PATH. Throws RunError when the system cannot start a process.
ProgramResult run_program(const std::vector<std::string>& command);

}  // namespace risorius::report
