// SPDX-License-Identifier: MIT
/// \file
/// Results of trackers over time as they are written as JSON.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/core/read_file.h"

namespace risorius::motion {

/// The value of the first key that is there and is not null.
std::optional<JsonCursor> any_key_of(const JsonCursor& json, const std::vector<std::string>& keys);

/// Results of a file: one a line, a list, or a list in an object under one of the keys `lists`. Throws Error.
std::vector<JsonCursor> json_results(const std::filesystem::path& file, const FileKind& kind,
                                     const std::vector<std::string>& lists);

}  // namespace risorius::motion
