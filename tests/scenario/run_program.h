// SPDX-License-Identifier: MIT
/// \file
/// Runs the real program and catches what it says.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

#include "paths.h"
#include "shell.h"
#include "temporary_folder.h"

namespace risorius::scenario {

using Folder = TemporaryFolder;

inline const std::filesystem::path kRoot = RISORIUS_SOURCE_DIR;

inline std::string text_of(const std::filesystem::path& file) { return bytes_of(file); }

struct Outcome {
    int code = -1;
    std::string out;
    std::string errors;
};

/// `before` stands before the program's name, as in "timeout 1"; the program is started in `folder`.
inline Outcome run(const std::string& arguments, const std::filesystem::path& folder,
                   const std::string& before = "") {
    const Folder scratch;
    const std::string command = "cd '" + folder.string() + "' && " + before + " '" +
                                RISORIUS_BINARY_DIR "/risorius' " + arguments + " >'" +
                                (scratch / "out").string() + "' 2>'" +
                                (scratch / "errors").string() + "'";
    const int code = exit_code(std::system(command.c_str()));
    return {code, text_of(scratch / "out"), text_of(scratch / "errors")};
}

}  // namespace risorius::scenario
