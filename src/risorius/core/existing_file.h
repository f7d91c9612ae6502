// SPDX-License-Identifier: MIT
/// \file
/// A file that a JSON file names. When it is missing, the message names the key that asks for it.
#pragma once

#include <filesystem>

#include "risorius/core/json_cursor.h"

namespace risorius {

/// The path that the string gives, relative to the folder of its own file. Throws Error when nothing is there.
std::filesystem::path existing_file(const JsonCursor& json);

}  // namespace risorius
