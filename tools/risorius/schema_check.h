// SPDX-License-Identifier: MIT
/// \file
/// Checks a file of the toolkit against the JSON Schema of its format.
#pragma once

#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"

namespace risorius::cli {

/// Formats that have a schema, such as "risorius-script", sorted by name.
std::vector<std::string> schema_formats();

/// Throws Error with the place, and what the schema expects there, when the file does not follow the schema of `format`.
void check_against_schema(const JsonCursor& json, const std::string& format);

}  // namespace risorius::cli
