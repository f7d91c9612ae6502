// SPDX-License-Identifier: MIT
/// \file
/// Runs another program and waits until it ends. It ends with this process, too, whatever ends this process.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace risorius::report {

struct ProgramResult {
    int exit_code = 0;   ///< 127: the program does not exist; 128 + N: signal N ended it
    std::string output;  ///< what the program wrote to standard output and standard error
};

/// What may be told to a program that runs, and what it tells meanwhile. Everything may be empty.
struct ProgramWatch {
    /// Gets each line of its output as soon as it is complete, without its end.
    std::function<void(const std::string& line)> line{};
    /// Is asked several times a second. Once it returns true, the program gets SIGTERM, and SIGKILL when it still runs 5 s later.
    std::function<bool()> stopped{};
    std::vector<std::string>
        environment{};  ///< "NAME=value", added to the variables of this process
};

/// Runs a command without a shell; `command[0]` is searched for in PATH. Throws RunError when the system cannot start a process.
ProgramResult run_program(const std::vector<std::string>& command, const ProgramWatch& watch = {});

}  // namespace risorius::report
