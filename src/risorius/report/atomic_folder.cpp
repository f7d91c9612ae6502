// SPDX-License-Identifier: MIT
#include "risorius/report/atomic_folder.h"

#include <unistd.h>

#include <algorithm>
#include <set>

#include "risorius/core/error.h"
#include "risorius/core/json_cursor.h"

namespace risorius::report {

namespace fs = std::filesystem;

namespace {

constexpr const char* kExpected =
    "a new folder, an empty one, or one with nothing but results of an earlier run";

/// The files that results.json lists; empty when there is no such file.
std::set<std::string> listed_files(const fs::path& folder) {
    std::set<std::string> files;
    try {
        const JsonCursor results = JsonCursor::read_file(folder / "results.json");
        for (const JsonCursor& file : results.at(kFilesKey).items()) files.insert(file.string());
    } catch (const Error&) {
        files.clear();
    }
    return files;
}

void check_replaceable(const fs::path& folder, const std::string& shown) {
    if (!fs::exists(folder)) return;
    if (!fs::is_directory(folder)) throw Error(shown, kExpected, "a file");
    const std::set<std::string> results = listed_files(folder);
    std::set<std::string> found;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (!entry.is_directory())
            found.insert(entry.path().lexically_relative(folder).generic_string());
    for (const std::string& file : found)
        if (!results.contains(file)) throw Error(shown, kExpected, "\"" + file + "\" in it");
}

/// The absolute path without links, "." and final slash.
fs::path canonical_folder(const fs::path& folder) {
    fs::path path = fs::weakly_canonical(fs::absolute(folder)).lexically_normal();
    if (!path.has_filename()) path = path.parent_path();
    return path;
}

}  // namespace

AtomicFolder::AtomicFolder(const fs::path& folder) {
    try {
        folder_ = canonical_folder(folder);
        check_replaceable(folder_, folder.string());
        const std::string mark = std::to_string(::getpid());
        partial_ = folder_.parent_path() / ("." + folder_.filename().string() + ".part-" + mark);
        for (fs::path parent = folder_.parent_path(); !fs::exists(parent);
             parent = parent.parent_path())
            made_.insert(made_.begin(), parent);
        fs::create_directories(partial_);
    } catch (const fs::filesystem_error& failure) {
        for (auto parent = made_.rbegin(); parent != made_.rend(); ++parent) {
            std::error_code ignored;
            fs::remove(*parent, ignored);
        }
        throw Error(folder.string(), "a folder that can be written", failure.code().message());
    }
}

AtomicFolder::~AtomicFolder() {
    if (committed_) return;
    std::error_code ignored;
    fs::remove_all(partial_, ignored);
    for (auto parent = made_.rbegin(); parent != made_.rend(); ++parent)
        fs::remove(*parent, ignored);  // fails for a folder that is not empty, as intended
}

void AtomicFolder::commit() {
    // Checked again, because a run may take minutes.
    check_replaceable(folder_, folder_.string());
    fs::path former = partial_;
    former += ".former";
    try {
        const bool replaces = fs::exists(folder_);
        if (replaces) fs::rename(folder_, former);
        try {
            fs::rename(partial_, folder_);
        } catch (const fs::filesystem_error&) {
            if (replaces) fs::rename(former, folder_);
            throw;
        }
    } catch (const fs::filesystem_error& failure) {
        throw RunError(folder_.string() + ": cannot be written: " + failure.code().message());
    }
    committed_ = true;
    std::error_code ignored;
    fs::remove_all(former, ignored);
}

}  // namespace risorius::report
