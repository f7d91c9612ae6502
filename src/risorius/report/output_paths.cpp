// SPDX-License-Identifier: MIT
#include "risorius/report/output_paths.h"

#include <nlohmann/json.hpp>
#include <string>

#include "risorius/core/error.h"
#include "risorius/core/file_reader.h"
#include "risorius/core/input_log.h"
#include "risorius/core/json_cursor.h"
#include "risorius/core/json_text.h"

namespace risorius::report {

namespace fs = std::filesystem;

namespace {

constexpr FileKind kFormerOutput{"a file of an earlier run", 4000 * kMegabyte};

}  // namespace

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
    const Json found = json_or_null(read_file(file, kFormerOutput));
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
    constexpr std::string_view kFirst = "frame\ttime_s";
    std::string first(kFirst.size(), '\0');
    first.resize(FileReader(table, kFormerOutput).read(first.data(), first.size()));
    if (first != kFirst)
        throw Error(table.string(), "no file, or the table of an earlier run",
                    "another file of that name");
}

}  // namespace risorius::report
