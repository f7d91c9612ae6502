// SPDX-License-Identifier: MIT
#include "tools/risorius/project_files.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "risorius/core/data_folder.h"
#include "risorius/core/error.h"
#include "risorius/core/input_log.h"
#include "risorius/core/json_object.h"
#include "risorius/core/json_text.h"

namespace risorius::cli {

namespace fs = std::filesystem;

namespace {

/// Whether a small file is a script; what cannot be read is none.
bool is_script(const fs::path& file) {
    constexpr std::uintmax_t kMostBytes = 300'000;
    std::error_code failed;
    if (!fs::is_regular_file(file, failed) || fs::file_size(file, failed) > kMostBytes || failed)
        return false;
    try {
        return format_of(json_or_null(read_json_text(file))) == "risorius-script";
    } catch (const Error&) {
        return false;
    }
}

}  // namespace

std::string format_of(const Json& json) {
    return json.is_object() && json.contains("format") && json["format"].is_string()
               ? json["format"].get<std::string>()
               : "";
}

fs::path in_project(const fs::path& folder, const JsonCursor& name,
                    const std::set<std::string>& endings, const std::string& what) {
    const std::string text = name.string();
    const fs::path file = fs::weakly_canonical(folder / fs::path(text));
    const fs::path below = file.lexically_relative(folder);
    const bool inside = !text.empty() && !below.empty() && *below.begin() != ".." && below != ".";
    if (!inside || !endings.contains(file.extension().string()))
        name.fail(what + " below " + folder.string());
    return file;
}

std::string list_of_scripts(const fs::path& folder) {
    Json scripts = Json::array(), samples = Json::array();
    constexpr int kMost = 200;
    const ReadingFormerOutput scripts_may_be_replaced;
    std::error_code ignored;
    std::vector<fs::path> found;
    for (fs::recursive_directory_iterator at(folder, fs::directory_options::skip_permission_denied,
                                             ignored);
         at != fs::recursive_directory_iterator() && found.size() < kMost; at.increment(ignored)) {
        if (at.depth() > 2) at.disable_recursion_pending();
        if (at->path().filename().string().starts_with(".")) at.disable_recursion_pending();
        if (at->path().extension() == ".json" && is_script(at->path())) found.push_back(at->path());
    }
    std::sort(found.begin(), found.end());
    for (const fs::path& file : found)
        scripts.push_back(file.lexically_relative(folder).generic_string());
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(data_folder() / "samples", ignored))
        if (fs::exists(entry.path() / "script.json"))
            names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    for (const std::string& name : names) samples.push_back(name);
    return json_text(json_object({{"type", "files"}, {"scripts", scripts}, {"samples", samples}}));
}

}  // namespace risorius::cli
