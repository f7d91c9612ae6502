// The files that a run writes beside its result, named after it.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace risorius::report {

/// "hello.mp4" -> "hello.mp4.json", "frames/" -> "frames.json"
std::filesystem::path output_path(const std::filesystem::path& out, const char* ending);

/// Throws Error when `file` is a folder, or JSON of none of these formats, or no JSON: something else would be lost under what is
/// written there.
void check_overwritten(const std::filesystem::path& file,
                       const std::vector<std::string_view>& formats, const std::string& expected);

/// Throws Error when a record or table would take the place of a file that no earlier run has written: a script named like
/// the record would be lost under it.
void check_record(const std::filesystem::path& record);
void check_table(const std::filesystem::path& table);

}  // namespace risorius::report
