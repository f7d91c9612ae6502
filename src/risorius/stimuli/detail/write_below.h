// SPDX-License-Identifier: MIT
/// \file
/// How the files of a set are handed over by what makes them.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace risorius::stimuli {

/// Writes a file of the set. `file`: relative to the folder of the set.
using WriteFile = std::function<void(const std::filesystem::path& file, const std::string& text)>;

}  // namespace risorius::stimuli
