// SPDX-License-Identifier: MIT
/// \file
/// Reads and checks files of all formats of the toolkit without running anything.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "risorius/core/progress_monitor.h"

namespace risorius::cli {

struct CheckResult {
    std::filesystem::path file;
    /// "script", "rig", "run" ... or "mesh"; "" when unknown.
    std::string format;
    std::string error;               ///< empty when the file is valid
    std::vector<std::string> notes;  ///< allowed values that may be mistakes
    bool ok() const { return error.empty(); }
};

/// Checks a file: a script with its rig, a rig with its mesh, landmarks against the standard anatomy, a design with all its
/// conditions, and an experiment with the bodies that it describes. Every JSON file is also checked against the schema of its
/// format, which its key "format" names. Any other file is checked as a mesh.
/// `monitor`: told of a design that has to be searched.
CheckResult check_file(const std::filesystem::path& file, const ProgressMonitor& monitor = {});

}  // namespace risorius::cli
