// SPDX-License-Identifier: MIT
/// \file
/// The folder of the cache: files appear whole, and there are never more of them than there is room for.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace risorius {

/// Puts a file into a folder, which it makes when it is missing. Then it removes what processes left that were killed while they
/// wrote, and the files that were not used for longest, until all together have at most `max_bytes`. It does without what fails.
void put_into_folder(const std::filesystem::path& folder, const std::string& name,
                     std::string_view bytes, std::uintmax_t max_bytes);

}  // namespace risorius
