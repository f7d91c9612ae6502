// SPDX-License-Identifier: MIT
/// \file
/// Tables of conditions as spreadsheets write them: a row of names, then a row of values for each condition, separated by tabs or
/// commas.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "risorius/design/detail/parameters.h"

namespace risorius::design {

/// Numbers, true and false are read as such, empty cells are left out, other cells are text. Throws Error naming the line.
std::vector<std::vector<Given>> read_table(const std::filesystem::path& file);

}  // namespace risorius::design
