#include "app/beside.h"

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "core/error.h"
#include "core/json_cursor.h"

namespace risorius::app {

namespace fs = std::filesystem;

fs::path beside(const fs::path& out, const char* ending) {
    fs::path base = out.has_filename() ? out : out.parent_path();
    base += ending;
    return base;
}

void check_record(const fs::path& record) {
    if (!fs::exists(record)) return;
    const Json found = Json::parse(std::ifstream(record), nullptr, false);
    const std::string format = found.is_object() ? found.value("format", "") : "";
    if (format != "risorius-run" && format != "risorius-sheet" && format != "risorius-comparison")
        throw Error(record.string(), "no file, or the record of an earlier run",
                    "another file of that name");
}

void check_table(const fs::path& table) {
    if (!fs::exists(table)) return;
    std::string first;
    std::getline(std::ifstream(table), first);
    if (!first.starts_with("frame\ttime_s"))
        throw Error(table.string(), "no file, or the table of an earlier run",
                    "another file of that name");
}

}  // namespace risorius::app
