// Reads files of any format of the toolkit with every check, without running anything.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace risorius::cli {

struct CheckResult {
    std::filesystem::path file;
    std::string format;  ///< "script", "rig", "run" ... or "mesh"; "" when it cannot be told
    std::string error;   ///< empty when the file can be used
    std::vector<std::string> notes;  ///< worth knowing
    bool ok() const { return error.empty(); }
};

/// A script is read with its rig, a rig with its mesh, landmarks against the standard anatomy, a design with all its
/// conditions, an experiment with the bodies it describes. Every JSON file is then held against the schema of its format. Its
/// key "format" says what it is; a file with another ending is a mesh.
CheckResult check_file(const std::filesystem::path& file);

}  // namespace risorius::cli
