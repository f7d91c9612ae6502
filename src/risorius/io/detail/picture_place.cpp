// SPDX-License-Identifier: MIT
#include "risorius/io/detail/picture_place.h"

#include <algorithm>
#include <cctype>
#include <system_error>

namespace risorius::io::detail {

namespace fs = std::filesystem;

namespace {

std::string small_letters(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

bool is_file(const fs::path& file) {
    std::error_code ignored;
    return fs::is_regular_file(file, ignored);
}

}  // namespace

const std::map<std::string, std::string>& PicturePlaces::names_in(const fs::path& folder) {
    constexpr int kMostListed = 100'000;
    const auto [entry, is_new] = listed_.try_emplace(folder);
    if (!is_new) return entry->second;
    std::error_code failed;
    int count = 0;
    for (fs::directory_iterator file(folder.empty() ? "." : folder, failed), end;
         !failed && file != end && ++count <= kMostListed; file.increment(failed)) {
        const std::string name = file->path().filename().string();
        // Of several names that differ in case only, the result is the same whatever the order of the folder.
        const auto [known, added] = entry->second.try_emplace(small_letters(name), name);
        if (!added) known->second = std::min(known->second, name);
    }
    return entry->second;
}

fs::path PicturePlaces::find(const fs::path& beside, std::string name) {
    std::replace(name.begin(), name.end(), '\\', '/');
    const fs::path named = beside / name;
    if (is_file(named)) return named;
    const fs::path last = fs::path(name).filename();
    if (last.empty()) return named;
    if (is_file(beside / last)) return beside / last;
    for (const fs::path& folder : {named.parent_path(), beside}) {
        const auto& names = names_in(folder);
        const auto found = names.find(small_letters(last.string()));
        if (found != names.end() && is_file(folder / found->second)) return folder / found->second;
    }
    return named;
}

}  // namespace risorius::io::detail
