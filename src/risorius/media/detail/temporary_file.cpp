// SPDX-License-Identifier: MIT
// Temporary names, and reading and writing of whole files. Every error of the operating system is checked.
#include "risorius/media/detail/temporary_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <string>

#include "risorius/core/error.h"
#include "risorius/core/read_file.h"

namespace risorius::media::detail {

namespace fs = std::filesystem;

namespace {

std::string next_suffix() {
    // The name must differ between processes, and between writers in one process.
    static std::atomic<unsigned> count{0};
    return ".part-" + std::to_string(::getpid()) + "-" + std::to_string(count++);
}

class Descriptor {
  public:
    explicit Descriptor(int value) : value_(value) {}
    ~Descriptor() {
        if (value_ >= 0) ::close(value_);
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    int get() const { return value_; }
    int close() {
        const int result = ::close(value_);
        value_ = -1;
        return result;
    }

  private:
    int value_;
};

}  // namespace

TemporaryFile::TemporaryFile(const fs::path& target)
    : target_(target.has_filename() ? target : target.parent_path()) {
    const fs::path folder = fs::absolute(target_).parent_path();
    for (fs::path above = folder; !above.empty(); above = above.parent_path()) {
        std::error_code failure;
        const fs::file_status status = fs::status(above, failure);
        if (fs::is_directory(status)) break;
        if (fs::exists(status)) throw Error(above.string(), "a folder", "a file");
        made_.insert(made_.begin(), above);
        if (above == above.parent_path()) break;
    }
    for (std::size_t i = 0; i < made_.size(); ++i) {
        std::error_code failure;
        fs::create_directory(made_[i], failure);
        if (!failure) continue;
        for (std::size_t j = i; j-- > 0;) {
            std::error_code ignored;
            fs::remove(made_[j], ignored);
        }
        throw RunError(made_[i].string() + ": the folder cannot be made: " + failure.message());
    }
    path_ = folder / ("." + target_.filename().string() + next_suffix());
}

TemporaryFile::~TemporaryFile() {
    if (kept_) return;
    std::error_code ignored;
    fs::remove_all(path_, ignored);
    // Innermost first. A folder into which someone else has put something stays.
    for (auto folder = made_.rbegin(); folder != made_.rend(); ++folder)
        fs::remove(*folder, ignored);
}

void TemporaryFile::replace_target() {
    // rename() cannot replace a folder that contains files. So the old folder is renamed first and removed last.
    std::error_code failure;
    fs::path old;
    if (fs::is_directory(path_) && fs::is_directory(target_)) {
        old = path_;
        old += ".old";
        fs::rename(target_, old, failure);
        if (failure)
            throw RunError(target_.string() + ": cannot be replaced: " + failure.message());
    }
    fs::rename(path_, target_, failure);
    if (failure) {
        std::error_code ignored;
        if (!old.empty()) fs::rename(old, target_, ignored);
        throw RunError(target_.string() + ": cannot be written: " + failure.message());
    }
    kept_ = true;
    std::error_code ignored;
    if (!old.empty()) fs::remove_all(old, ignored);
}

void write_whole(const fs::path& file, const void* bytes, std::size_t count) {
    TemporaryFile temporary(file);
    const auto fail = [&] {
        return RunError(file.string() + ": cannot be written: " + std::strerror(errno));
    };
    Descriptor out(::open(temporary.path().c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
    if (out.get() < 0) throw fail();
    const char* next = static_cast<const char*>(bytes);
    while (count > 0) {
        const ssize_t written = ::write(out.get(), next, count);
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) throw fail();
        next += written;
        count -= static_cast<std::size_t>(written);
    }
    if (out.close() != 0) throw fail();
    temporary.replace_target();
}

std::vector<unsigned char> read_whole(const fs::path& file, const char* expected) {
    return risorius::read_bytes(file, {expected, 2000 * kMegabyte});
}

}  // namespace risorius::media::detail
