// SPDX-License-Identifier: MIT
/// \file
/// Reads and checks files of all formats of the toolkit without running anything.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace risorius::cli {

struct CheckResult {
    std::filesystem::path file;
    /// "script", "rig", "run" ... or "mesh"; "" when it is unknown.
    std::string format;
    std::string error;               ///< empty when the file can be used
    std::vector<std::string> notes;  ///< what is allowed, but may be a mistake
    bool ok() const { return error.empty(); }
};

/// Reads a script with its rig, a rig with its mesh, landmarks against the standard anatomy, a design with all its conditions and an
/// experiment with the bodies that it describes. Every JSON file is then held against the schema of its
/// format, which its key "format" names; any other file is a mesh.
CheckResult check_file(const std::filesystem::path& file);

}  // namespace risorius::cli
