// SPDX-License-Identifier: MIT
/// \file
/// Reads JSON as text and then parses it, so that the same bytes can also be hashed.
#pragma once

#include <filesystem>
#include <string>

#include "risorius/core/json_cursor.h"

namespace risorius {

/// The bytes of a JSON file. The file is opened once, so it may be a pipe. Throws Error when it does not exist, is a folder or
/// is empty.
std::string read_json_text(const std::filesystem::path& file);

/// Parses text that is in memory. `name` replaces the path of a file in messages, and relative paths begin at its folder.
/// Throws Error when the JSON is malformed (with line and column) or when a key is given twice.
JsonCursor parse_json_text(const std::string& text, const std::filesystem::path& name);

}  // namespace risorius
