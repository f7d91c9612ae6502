// SPDX-License-Identifier: MIT
/// \file
/// Converts names from files to names that are valid for files and folders on any system.
#pragma once

#include <set>
#include <string>

namespace risorius::report {

/// Returns a name of letters, digits, "_" and "-" only. It differs from all of `taken`, also without regard to case, and is added
/// to `taken`.
std::string folder_name(const std::string& name, std::set<std::string>& taken);

}  // namespace risorius::report
