// SPDX-License-Identifier: MIT
#include "risorius/core/data_folder.h"

#include <dlfcn.h>

#include <cstdlib>
#include <mutex>
#include <string>
#include <vector>

#include "risorius/core/detail/installed_data.h"
#include "risorius/core/error.h"

namespace risorius {
namespace {

namespace fs = std::filesystem;

std::mutex folder_mutex;
fs::path chosen;

/// A function, since programs add to it before main().
std::vector<fs::path>& installed() {
    static std::vector<fs::path> folders;
    return folders;
}

bool holds_data(const fs::path& folder) {
    std::error_code ignored;
    return fs::is_directory(folder / "rigs" / "standard", ignored) &&
           fs::is_directory(folder / "models", ignored);
}

std::vector<fs::path> candidates() {
    std::vector<fs::path> folders;
    const fs::path own = code_folder();
    if (!own.empty()) {
        // Covers bin/risorius and lib/librisorius.so, and also lib/x86_64-linux-gnu/librisorius.so.
        for (const char* up : {"..", "../.."})
            folders.push_back((own / up / "share" / "risorius").lexically_normal());
        for (fs::path above = own; above.has_relative_path(); above = above.parent_path())
            folders.push_back(above);
    }
    const char* listed = std::getenv("XDG_DATA_DIRS");
    std::string rest = listed && *listed ? listed : "/usr/local/share:/usr/share";
    for (std::size_t begin = 0; begin <= rest.size();) {
        const std::size_t end = std::min(rest.find(':', begin), rest.size());
        if (end > begin) folders.push_back(fs::path(rest.substr(begin, end - begin)) / "risorius");
        begin = end + 1;
    }
    folders.insert(folders.end(), installed().begin(), installed().end());
    return folders;
}

}  // namespace

bool add_installed_data(const char* folder) {
    installed().emplace_back(folder);
    return true;
}

std::filesystem::path code_folder() {
    std::error_code failed;
    const fs::path program = fs::read_symlink("/proc/self/exe", failed);
    Dl_info info{};
    if (::dladdr(reinterpret_cast<const void*>(&data_folder), &info) != 0 && info.dli_fname) {
        // A program's own name may be relative to a folder it has left since. A library's path is absolute.
        const fs::path file = fs::weakly_canonical(info.dli_fname, failed);
        if (!failed && file.is_absolute() && fs::exists(file, failed)) return file.parent_path();
    }
    return program.parent_path();
}

std::filesystem::path data_folder() {
    const std::lock_guard<std::mutex> lock(folder_mutex);
    if (!chosen.empty()) return chosen;
    if (const char* named = std::getenv("RISORIUS_DATA"); named && *named) {
        if (!holds_data(named))
            throw Error("RISORIUS_DATA", "a folder that holds rigs/standard and models",
                        in_quotes(named));
        return named;
    }
    const std::vector<fs::path> folders = candidates();
    for (const fs::path& folder : folders)
        if (holds_data(folder)) return chosen = folder;
    std::string listed;
    for (const fs::path& folder : folders) listed += (listed.empty() ? "" : ", ") + folder.string();
    throw Error("data files",
                "rigs/standard and models in the folder that the environment variable "
                "RISORIUS_DATA or set_data_folder() names, or in one of " +
                    listed,
                "no such folders");
}

void set_data_folder(const std::filesystem::path& folder) {
    const std::lock_guard<std::mutex> lock(folder_mutex);
    chosen = folder;
}

}  // namespace risorius
