// SPDX-License-Identifier: MIT
/// \file
/// The option that says which part of a head a group of a mesh is.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace risorius::cli {

/// Role -> groups, of texts such as "skin=face,neck". Throws Error.
std::map<std::string, std::vector<std::string>> parts_of(const std::vector<std::string>& texts);

}  // namespace risorius::cli
