// SPDX-License-Identifier: MIT
/// \file
/// Finds the data files that the library itself reads: the standard anatomy, the embedded head and the figures of the thesis.
#pragma once

#include <filesystem>

namespace risorius {

/// The folder that holds `rigs`, `models` and `samples`. The places are searched in this order:
///   1. the folder given to set_data_folder(),
///   2. the environment variable RISORIUS_DATA,
///   3. `share/risorius` beside the folder of the library or program that contains this code (an installation),
///   4. the folders above that library or program (a source tree with its build folder),
///   5. `risorius` in the folders of XDG_DATA_DIRS,
///   6. the installation that find_package(risorius) found, for a program that links it (detail/installed_data.h).
/// Throws Error that names the places when none of them holds the files.
std::filesystem::path data_folder();

/// For programs that bring the data files along. An empty path makes data_folder() search again.
void set_data_folder(const std::filesystem::path& folder);

}  // namespace risorius
