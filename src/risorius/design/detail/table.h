// SPDX-License-Identifier: MIT
/// \file
/// Tables of conditions as spreadsheets write them: a row of names, followed by one row of values per condition, separated by
/// tabs or commas.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "risorius/design/detail/parameters.h"

namespace risorius::design {

/// Reads a table. Numbers, true and false are converted, empty cells are omitted, other cells are text. Throws Error naming the
/// line.
std::vector<std::vector<Given>> read_table(const std::filesystem::path& file);

}  // namespace risorius::design
