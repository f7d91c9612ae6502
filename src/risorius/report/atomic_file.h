// SPDX-License-Identifier: MIT
/// \file
/// A text file that is written completely or not at all.
#pragma once

#include <filesystem>
#include <string>

#include "risorius/core/output_set.h"

namespace risorius::report {

/// Writes a file as write_file() does. Throws RunError.
inline void write_text(const std::filesystem::path& file, const std::string& text) {
    write_file(file, text);
}

}  // namespace risorius::report
