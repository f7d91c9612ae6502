// Tables of conditions as spreadsheets write them: a row of names, then a row of values each; tabs or commas.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "risorius/design/detail/parameters.h"

namespace risorius::design {

/// Cells that are numbers, true or false become those, empty ones are left out, others are text. Throws Error with the line.
std::vector<std::vector<Given>> read_table(const std::filesystem::path& file);

}  // namespace risorius::design
