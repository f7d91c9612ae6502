// SPDX-License-Identifier: MIT
#include "risorius/core/detail/result_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <system_error>
#include <vector>

namespace risorius {

namespace fs = std::filesystem;

namespace {

constexpr const char* kPart = ".part-";  // in the name of a file that is being written

/// An open file that is closed.
struct Descriptor {
    int number;
    ~Descriptor() {
        if (number >= 0) ::close(number);
    }
};

bool write_all(int file, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t count = ::write(file, bytes.data(), bytes.size());
        if (count <= 0) return false;
        bytes.remove_prefix(static_cast<std::size_t>(count));
    }
    return true;
}

/// Removes what processes left that were killed while they wrote, and what was not used for longest, until the limit holds.
void make_room(const fs::path& folder, std::uintmax_t max_bytes) {
    struct Kept {
        fs::path file;
        std::uintmax_t bytes;
        fs::file_time_type used;
    };
    std::vector<Kept> all;
    std::uintmax_t total = 0;
    std::error_code failed;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, failed)) {
        if (!entry.is_regular_file(failed)) continue;
        if (entry.path().filename().string().find(kPart) != std::string::npos) {
            const Descriptor file{::open(entry.path().c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW)};
            if (file.number >= 0 && ::flock(file.number, LOCK_EX | LOCK_NB) == 0)
                fs::remove(entry.path(), failed);
            continue;
        }
        const std::uintmax_t bytes = entry.file_size(failed);
        if (failed) continue;
        all.push_back({entry.path(), bytes, entry.last_write_time(failed)});
        total += bytes;
    }
    std::sort(all.begin(), all.end(), [](const Kept& a, const Kept& b) { return a.used < b.used; });
    for (const Kept& oldest : all) {
        if (total <= max_bytes) break;
        if (fs::remove(oldest.file, failed)) total -= oldest.bytes;
    }
}

}  // namespace

// A file that is being written is locked, so that others do not take it for one that was left.
void put_into_folder(const fs::path& folder, const std::string& name, std::string_view bytes,
                     std::uintmax_t max_bytes) {
    std::error_code failed;
    fs::create_directories(folder, failed);
    std::string part = (folder / (name + kPart + "XXXXXX")).string();
    const Descriptor file{::mkostemp(part.data(), O_CLOEXEC)};
    if (file.number < 0) return;
    const bool whole =
        ::flock(file.number, LOCK_EX | LOCK_NB) == 0 && write_all(file.number, bytes);
    if (!whole || ::rename(part.c_str(), (folder / name).c_str()) != 0) ::unlink(part.c_str());
    make_room(folder, max_bytes);
}

}  // namespace risorius
