// SPDX-License-Identifier: MIT
#include "risorius/core/detail/checked_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <vector>

#include "risorius/core/error.h"

namespace risorius::detail {

namespace fs = std::filesystem;

namespace {

/// With more files than this, the whole file system is synchronized at once, which is quicker.
constexpr std::size_t kManyFiles = 64;

void check_sync(int result, const fs::path& place) {
    if (result != 0 && errno != EINVAL && errno != ENOSYS && errno != EROFS) fail_to_write(place);
}

}  // namespace

Descriptor& Descriptor::operator=(Descriptor&& other) noexcept {
    if (this != &other) {
        close();
        value_ = other.value_;
        other.value_ = -1;
    }
    return *this;
}

int Descriptor::close() {
    if (value_ < 0) return 0;
    const int result = ::close(value_);
    value_ = -1;
    return result;
}

Descriptor open_file(const fs::path& file, int flags, int mode) {
    int value;
    do value = ::open(file.c_str(), flags | O_CLOEXEC | O_NOFOLLOW, mode);
    while (value < 0 && errno == EINTR);
    return Descriptor(value);
}

void fail_to_write(const fs::path& place) {
    throw RunError(place.string() + ": cannot be written: " + std::strerror(errno));
}

void write_all(const Descriptor& out, std::string_view bytes, const fs::path& place) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(out.get(), bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) fail_to_write(place);
        bytes.remove_prefix(static_cast<std::size_t>(written));
    }
}

void write_new_file(const fs::path& file, std::string_view bytes, bool sync,
                    const fs::path& place) {
    Descriptor out = open_file(file, O_WRONLY | O_CREAT | O_EXCL);
    if (!out) fail_to_write(place);
    write_all(out, bytes, place);
    if (sync) check_sync(::fsync(out.get()), place);
    if (out.close() != 0) fail_to_write(place);
}

void sync_path(const fs::path& path, const fs::path& place) {
    Descriptor opened = open_file(path, O_RDONLY);
    if (!opened) fail_to_write(place);
    check_sync(::fsync(opened.get()), place);
    if (opened.close() != 0) fail_to_write(place);
}

void sync_tree(const fs::path& path, const fs::path& place) {
    std::vector<fs::path> all{path};
    std::error_code failure;
    if (fs::is_directory(fs::symlink_status(path, failure)))
        for (auto entry = fs::recursive_directory_iterator(path, failure);
             !failure && entry != fs::recursive_directory_iterator(); entry.increment(failure))
            all.push_back(entry->path());
    if (failure) throw RunError(place.string() + ": cannot be written: " + failure.message());
    if (all.size() <= kManyFiles) {
        for (auto one = all.rbegin(); one != all.rend(); ++one) sync_path(*one, place);
        return;
    }
    Descriptor opened = open_file(path, O_RDONLY);
    if (!opened) fail_to_write(place);
    check_sync(::syncfs(opened.get()), place);
}

}  // namespace risorius::detail
