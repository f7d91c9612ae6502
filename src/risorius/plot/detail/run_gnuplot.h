// SPDX-License-Identifier: MIT
/// \file
/// Runs gnuplot on a script, without a shell and without the user's own settings.
#pragma once

#include <filesystem>
#include <string>

namespace risorius::plot {

/// Runs `program` on `script` (a file name) in `folder` and waits for it. Throws RunError with gnuplot's message when it fails,
/// and with the name of the package when there is no such program.
void run_gnuplot(const std::string& program, const std::string& script,
                 const std::filesystem::path& folder);

}  // namespace risorius::plot
