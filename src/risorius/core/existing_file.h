// SPDX-License-Identifier: MIT
/// \file
/// Finds a file that a JSON file names. When it is missing, the message of the Error gives the key with its name.
#pragma once

#include <filesystem>

#include "risorius/core/json_cursor.h"

namespace risorius {

/// Returns the path in the string `json`, which is relative to the folder of the JSON file. Throws Error when no such file
/// exists.
std::filesystem::path existing_file(const JsonCursor& json);

}  // namespace risorius
