// SPDX-License-Identifier: MIT
#include "risorius/core/read_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "risorius/core/error.h"
#include "risorius/core/input_log.h"

namespace risorius {

namespace {

class InputFile {
  public:
    InputFile(const std::filesystem::path& file, const FileKind& kind) : file_(file), kind_(kind) {
        // The kind is asked for before the file is opened: opening a device can have an effect.
        if (::stat(file.c_str(), &status_) != 0) fail(reason());
        check_type();
        do descriptor_ = ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY);
        while (descriptor_ < 0 && errno == EINTR);
        if (descriptor_ < 0) fail(reason());
        try {
            if (::fstat(descriptor_, &status_) != 0) fail(reason());
            check_type();
            check_size();
            note_input(status_.st_dev, status_.st_ino);
        } catch (...) {
            ::close(descriptor_);
            throw;
        }
    }
    ~InputFile() { ::close(descriptor_); }
    InputFile(const InputFile&) = delete;
    InputFile& operator=(const InputFile&) = delete;

    bool is_regular() const { return S_ISREG(status_.st_mode); }

    template <typename Bytes>
    Bytes read() const {
        Bytes bytes;
        // One byte more than the size of a regular file shows its end without growing.
        std::size_t room = is_regular() ? static_cast<std::size_t>(status_.st_size) + 1 : kBlock;
        for (std::size_t used = 0;;) {
            bytes.resize(used + room);
            const ssize_t got = ::read(descriptor_, bytes.data() + used, room);
            if (got < 0 && errno == EINTR) continue;
            if (got < 0) fail(reason());
            used += static_cast<std::size_t>(got);
            if (got == 0) {
                bytes.resize(used);
                return bytes;
            }
            if (used > kind_.max_bytes) fail_as_too_large("more than that");
            room = std::max(kBlock, std::min<std::size_t>(used, kind_.max_bytes));
        }
    }

  private:
    static constexpr std::size_t kBlock = 1 << 16;

    void check_type() const {
        if (S_ISDIR(status_.st_mode)) fail("a folder");
        if (!S_ISREG(status_.st_mode) && !S_ISFIFO(status_.st_mode)) fail("a device or socket");
    }
    void check_size() const {
        if (is_regular() && static_cast<std::uint64_t>(status_.st_size) > kind_.max_bytes)
            fail_as_too_large(std::to_string(status_.st_size) + " bytes");
    }
    static std::string reason() {
        if (errno == ENOENT) return "no such file";
        return "one that cannot be read (" + std::string(std::strerror(errno)) + ")";
    }
    [[noreturn]] void fail(const std::string& found) const {
        throw Error(file_.string(), std::string(kind_.name), found);
    }
    [[noreturn]] void fail_as_too_large(const std::string& found) const {
        throw Error(file_.string(),
                    std::string(kind_.name) + " of at most " +
                        std::to_string(kind_.max_bytes / kMegabyte) + " MB",
                    found);
    }

    std::filesystem::path file_;
    FileKind kind_;
    struct ::stat status_ {};
    int descriptor_ = -1;
};

}  // namespace

std::string read_file(const std::filesystem::path& file, const FileKind& kind) {
    return InputFile(file, kind).read<std::string>();
}

std::vector<std::uint8_t> read_bytes(const std::filesystem::path& file, const FileKind& kind) {
    return InputFile(file, kind).read<std::vector<std::uint8_t>>();
}

void check_file(const std::filesystem::path& file, const FileKind& kind) {
    const InputFile opened(file, kind);
    if (!opened.is_regular())
        throw Error(file.string(), std::string(kind.name) + " that is not a pipe", "a pipe");
}

}  // namespace risorius
