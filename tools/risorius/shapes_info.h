// SPDX-License-Identifier: MIT
/// \file
/// A summary of the blend shapes in a glTF file.
#pragma once

#include <filesystem>

#include "risorius/core/json_cursor.h"

namespace risorius::cli {

/// Returns file, number of vertices, and of each shape the name, the number of vertices that it moves and its largest displacement,
/// mm when the file is in metres as glTF asks. Throws Error for a file without named shapes.
Json shapes_info(const std::filesystem::path& file);

}  // namespace risorius::cli
