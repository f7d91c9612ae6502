// SPDX-License-Identifier: MIT
// Reads whole files. Every error of the operating system is checked.
#include "risorius/media/detail/temporary_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <string>

#include "risorius/core/error.h"

namespace risorius::media::detail {

namespace fs = std::filesystem;

namespace {

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

std::vector<unsigned char> read_whole(const fs::path& file, const char* expected) {
    std::error_code ignored;
    if (!fs::exists(file, ignored)) throw Error(file.string(), expected, "no such file");
    if (fs::is_directory(file, ignored)) throw Error(file.string(), expected, "a folder");
    Descriptor in(::open(file.c_str(), O_RDONLY | O_CLOEXEC));
    std::vector<unsigned char> bytes;
    std::vector<unsigned char> block(1 << 20);
    for (;;) {
        const ssize_t got = in.get() < 0 ? -1 : ::read(in.get(), block.data(), block.size());
        if (got < 0 && in.get() >= 0 && errno == EINTR) continue;
        if (got < 0) throw Error(file.string(), expected, "a file that cannot be read");
        if (got == 0) return bytes;
        bytes.insert(bytes.end(), block.begin(), block.begin() + got);
    }
}

}  // namespace risorius::media::detail
