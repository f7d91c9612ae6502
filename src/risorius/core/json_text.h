// SPDX-License-Identifier: MIT
/// \file
/// Reads JSON as text and then parses it, so that the same bytes can also be hashed. Writes JSON as text.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "risorius/core/json_cursor.h"
#include "risorius/core/read_file.h"

namespace risorius {

inline constexpr FileKind kJsonFile{"a JSON file", 32 * kMegabyte};
inline constexpr int kDeepestJson = 200;  ///< arrays and objects in one another

/// The bytes of a JSON file without a byte-order mark. The file is opened once, so it may be a pipe. Throws Error as read_text()
/// does, and when the file is empty.
std::string read_json_text(const std::filesystem::path& file);

/// Parses text that is in memory. `name` replaces the path of a file in messages, and relative paths begin at its folder.
/// Throws Error when the JSON is malformed or nested too deep (with line and column) or when a key is given twice.
JsonCursor parse_json_text(const std::string& text, const std::filesystem::path& name);

/// The value of text that this program may have written, such as a record or a line of a log; null when it is no JSON. Never
/// throws Error.
Json json_or_null(std::string_view text);

/// Writes a value as JSON, with `indent` spaces a level, or in one line without it. Bytes that are not UTF-8, such as those of a
/// file's name, become U+FFFD. Does not throw for any value.
std::string json_text(const Json& value, int indent = -1);

}  // namespace risorius
