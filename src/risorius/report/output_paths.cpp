// SPDX-License-Identifier: MIT
#include "risorius/report/output_paths.h"

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "risorius/core/error.h"
#include "risorius/core/input_log.h"
#include "risorius/core/json_cursor.h"

namespace risorius::report {

namespace fs = std::filesystem;

fs::path output_path(const fs::path& out, const char* ending) {
    fs::path base = out.has_filename() ? out : out.parent_path();
    base += ending;
    return base;
}

void check_overwritten(const fs::path& file, const std::vector<std::string_view>& formats,
                       const std::string& expected) {
    const ReadingFormerOutput former;
    if (!file.has_filename() || fs::is_directory(file))
        throw Error(file.string(), expected, "a folder");
    if (!fs::exists(file)) return;
    const Json found = Json::parse(std::ifstream(file), nullptr, false);
    const auto format = found.is_object() ? found.find("format") : found.end();
    for (std::string_view known : formats)
        if (format != found.end() && *format == known) return;
    throw Error(file.string(), expected, "another file of that name");
}

void check_record(const fs::path& record) {
    check_overwritten(record, {"risorius-run", "risorius-sheet", "risorius-comparison"},
                      "no file, or the record of an earlier run");
}

void check_table(const fs::path& table) {
    const ReadingFormerOutput former;
    if (!fs::exists(table)) return;
    std::string first;
    std::getline(std::ifstream(table), first);
    if (!first.starts_with("frame\ttime_s"))
        throw Error(table.string(), "no file, or the table of an earlier run",
                    "another file of that name");
}

}  // namespace risorius::report
