// Another program, run to its end.
#pragma once

#include <string>
#include <vector>

namespace risorius::report {

struct ProgramResult {
    int exit_code = 0;   ///< 127: there is no such program
    std::string output;  ///< standard output and error
};

/// `command[0]` is searched in PATH; no shell has a part in it. Throws RunError when the system cannot start anything.
ProgramResult run_program(const std::vector<std::string>& command);

}  // namespace risorius::report
