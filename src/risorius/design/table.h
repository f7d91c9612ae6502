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
///
/// `names`: names of parameters in the first row, or any that differ, as tables of other programs have them.
enum class ColumnNames { kOfParameters, kAny };
std::vector<std::vector<Given>> read_table(const std::filesystem::path& file,
                                           ColumnNames names = ColumnNames::kOfParameters);

/// The place of a row that is not empty, in messages: that of its first cell, "file:line, name".
std::string row_place(const std::vector<Given>& row);

}  // namespace risorius::design
