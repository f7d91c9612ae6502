// SPDX-License-Identifier: MIT
/// \file
/// The files that the page of the studio may name: those below the folder of the project.
#pragma once

#include <filesystem>
#include <set>
#include <string>

#include "risorius/core/json_cursor.h"

namespace risorius::cli {

/// The format that a JSON file says it has, or "".
std::string format_of(const Json& json);

/// The file that a message names, with links resolved. Throws Error when it does not lie below `folder`, which is canonical, or
/// has another ending. `what`: "a mesh".
std::filesystem::path in_project(const std::filesystem::path& folder, const JsonCursor& name,
                                 const std::set<std::string>& endings, const std::string& what);

/// {"type": "files", "scripts": below the folder, "samples": of the toolkit}
std::string list_of_scripts(const std::filesystem::path& folder);

}  // namespace risorius::cli
