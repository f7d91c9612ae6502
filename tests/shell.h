// SPDX-License-Identifier: MIT
/// \file
/// Runs a shell command and catches what it prints and how it ends.
#pragma once

#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <string>

namespace risorius {

struct ShellResult {
    int code = -1;  ///< exit code; -1 when the command could not be run or was ended by a signal
    std::string output;  ///< standard output, and standard error where the command redirects it
};

/// The exit code in a status of wait(), pclose() or std::system(); -1 for anything but an exit.
inline int exit_code(int status) { return WIFEXITED(status) ? WEXITSTATUS(status) : -1; }

/// Runs `command` by sh, as popen() does.
inline ShellResult run_shell(const std::string& command) {
    ShellResult result;
    std::FILE* pipe = ::popen(command.c_str(), "r");
    if (!pipe) return result;
    std::array<char, 4096> block;
    while (const std::size_t got = std::fread(block.data(), 1, block.size(), pipe))
        result.output.append(block.data(), got);
    result.code = exit_code(::pclose(pipe));
    return result;
}

}  // namespace risorius
