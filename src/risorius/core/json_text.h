// SPDX-License-Identifier: MIT
/// \file
/// JSON that is read as text first, so that the same bytes can be parsed and hashed.
#pragma once

#include <filesystem>
#include <string>

#include "risorius/core/json_cursor.h"

namespace risorius {

/// The bytes of a JSON file; the file is opened once, so it may be a pipe. Throws Error when there is no such file, when it is a
/// folder or when it is empty.
std::string read_json_text(const std::filesystem::path& file);

/// Parses text that is in memory already. `name` stands where the path of a file would: in messages, and as the folder from which
/// relative paths start. Throws Error on malformed JSON (with line and column) or a key given twice.
JsonCursor parse_json_text(const std::string& text, const std::filesystem::path& name);

}  // namespace risorius
