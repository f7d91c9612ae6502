// SPDX-License-Identifier: MIT
/// \file
/// Tells a program that links an installed static library where the data of that installation lie.
///
/// The target risorius::core of find_package(risorius) defines RISORIUS_INSTALLED_DATA. A program that includes any header of the library
/// then names this folder to data_folder() before main() begins.
#pragma once

namespace risorius {

/// Makes data_folder() look in `folder` too, last of all. Returns true.
bool add_installed_data(const char* folder);

#ifdef RISORIUS_INSTALLED_DATA
inline const bool kInstalledDataAdded = add_installed_data(RISORIUS_INSTALLED_DATA);
#endif

}  // namespace risorius
