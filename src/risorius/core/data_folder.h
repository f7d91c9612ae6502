// SPDX-License-Identifier: MIT
/// \file
/// Finds the data files that the library itself reads: the standard anatomy, the embedded head, and the figures of
/// M. Dobsik, Computer Animation of Soft Tissues, Brno 2005.
#pragma once

#include <filesystem>

namespace risorius {

/// Returns the folder that contains `rigs`, `models` and `samples`. These places are searched in this order:
///   1. the folder given to set_data_folder(),
///   2. the environment variable RISORIUS_DATA,
///   3. `share/risorius` beside the folder of the library or program that contains this code (an installation),
///   4. the folders above that library or program (a source tree with its build folder),
///   5. `risorius` in the folders of XDG_DATA_DIRS,
///   6. the installation that find_package(risorius) found, for a program that links it (detail/installed_data.h).
/// Throws Error that names the places when none of them holds the files.
std::filesystem::path data_folder();

/// The folder of the program or shared library that contains this code; empty when the system does not tell.
std::filesystem::path code_folder();

/// Sets the folder that data_folder() searches first, for programs that come with their own data files. An empty path removes
/// it.
void set_data_folder(const std::filesystem::path& folder);

}  // namespace risorius
