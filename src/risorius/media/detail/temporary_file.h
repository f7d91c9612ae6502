// SPDX-License-Identifier: MIT
/// \file
/// Reads a whole file.
#pragma once

#include <filesystem>
#include <vector>

namespace risorius::media::detail {

/// Returns the bytes of a file. Throws Error when it is missing, is a folder or cannot be read; `expected` is part of the
/// message.
std::vector<unsigned char> read_whole(const std::filesystem::path& file, const char* expected);

}  // namespace risorius::media::detail
