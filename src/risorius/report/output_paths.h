// SPDX-License-Identifier: MIT
/// \file
/// Names of the files that a run writes next to its main output, and checks before files are overwritten.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace risorius::report {

/// Returns the path of a file next to `out`: "hello.mp4.json" for "hello.mp4", "frames.json" for "frames/".
std::filesystem::path output_path(const std::filesystem::path& out, const char* ending);

/// Throws Error when `file` exists and is not JSON of one of these formats, because it would be overwritten.
void check_overwritten(const std::filesystem::path& file,
                       const std::vector<std::string_view>& formats, const std::string& expected);

/// These two functions throw Error when a record or a table would overwrite a file that no earlier run has written, such as a
/// script of that name.
void check_record(const std::filesystem::path& record);
void check_table(const std::filesystem::path& table);

}  // namespace risorius::report
