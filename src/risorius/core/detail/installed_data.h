// SPDX-License-Identifier: MIT
/// \file
/// For programs that link an installed static library: gives data_folder() the folder with the data of that installation.
///
/// The target risorius::core of find_package(risorius) defines RISORIUS_INSTALLED_DATA. In a program that includes any header
/// of the library, this folder is then added before main() begins.
#pragma once

namespace risorius {

/// Makes data_folder() search `folder` too, after all other places. Returns true.
bool add_installed_data(const char* folder);

#ifdef RISORIUS_INSTALLED_DATA
inline const bool kInstalledDataAdded = add_installed_data(RISORIUS_INSTALLED_DATA);
#endif

}  // namespace risorius
