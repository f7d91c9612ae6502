// SPDX-License-Identifier: MIT
#include "risorius/report/atomic_folder.h"

#include <set>

#include "risorius/core/error.h"
#include "risorius/core/input_log.h"
#include "risorius/core/json_cursor.h"

namespace risorius::report {

namespace fs = std::filesystem;

namespace {

constexpr const char* kExpected =
    "a new folder, an empty one, or one with nothing but results of an earlier run";

/// The files that results.json lists; empty when there is no such file.
std::set<std::string> listed_files(const fs::path& folder) {
    const ReadingFormerOutput former;
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

}  // namespace

void check_results_folder(const fs::path& folder) {
    try {
        check_replaceable(folder, folder.string());
    } catch (const fs::filesystem_error& failure) {
        throw Error(folder.string(), "a folder that can be written", failure.code().message());
    }
}

fs::path real_results_folder(const fs::path& folder) {
    std::error_code failure;
    fs::path path = fs::weakly_canonical(fs::absolute(folder), failure).lexically_normal();
    if (failure) throw Error(folder.string(), "a folder that can be written", failure.message());
    if (!path.has_filename()) path = path.parent_path();
    return path;
}

AtomicFolder::AtomicFolder(const fs::path& folder, OutputSet::Then then)
    : folder_(folder), partial_(folder) {
    if (is_private_output(folder)) {
        make_folder(folder);
        return;
    }
    check_results_folder(folder);
    const fs::path real = real_results_folder(folder);
    try {
        own_.emplace(real.parent_path(), then);
        partial_ = own_->folder(real);
    } catch (const RunError& failure) {
        const std::string message = failure.what();
        throw Error(folder.string(), "a folder that can be written",
                    message.substr(message.rfind(": ") + 2));
    }
}

void AtomicFolder::commit() {
    if (!own_) return;
    // Checked again, because a run may take minutes.
    check_results_folder(folder_);
    own_->commit();
    own_.reset();
}

}  // namespace risorius::report
