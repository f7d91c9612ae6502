// SPDX-License-Identifier: MIT
/// \file
/// Makes names that come from files usable as names of files and folders on any system.
#pragma once

#include <set>
#include <string>

namespace risorius::report {

/// A name of letters, digits, "_" and "-" only. It differs from all of `taken`, also without regard to case, and is added to them.
std::string folder_name(const std::string& name, std::set<std::string>& taken);

}  // namespace risorius::report
