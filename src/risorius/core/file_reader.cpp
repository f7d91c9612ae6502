// SPDX-License-Identifier: MIT
#include "risorius/core/file_reader.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "risorius/core/error.h"
#include "risorius/core/input_log.h"
#include "risorius/core/stand_in.h"

namespace risorius {

namespace {

std::string reason() {
    if (errno == ENOENT) return "no such file";
    return "one that cannot be read (" + std::string(std::strerror(errno)) + ")";
}

}  // namespace

FileReader::FileReader(const std::filesystem::path& file, const FileKind& kind)
    : file_(file), kind_(kind) {
    const std::filesystem::path place = file_to_read(file);
    // The kind is asked for before the file is opened: opening a device can have an effect.
    struct ::stat status {};
    if (::stat(place.c_str(), &status) != 0) fail(reason());
    check_type(status.st_mode);
    // Opening a pipe would wait for its writer, who may never come.
    do descriptor_ = ::open(place.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY | O_NONBLOCK);
    while (descriptor_ < 0 && errno == EINTR);
    if (descriptor_ < 0) fail(reason());
    try {
        if (::fstat(descriptor_, &status) != 0) fail(reason());
        check_type(status.st_mode);
        regular_ = S_ISREG(status.st_mode);
        size_ = regular_ ? static_cast<std::uint64_t>(status.st_size) : 0;
        if (size_ > kind_.max_bytes) fail_as_too_large(std::to_string(size_) + " bytes");
        note_input(status.st_dev, status.st_ino);
        if (!regular_) wait_for_writer();
        if (::fcntl(descriptor_, F_SETFL, 0) != 0) fail(reason());
    } catch (...) {
        ::close(descriptor_);
        throw;
    }
}

void FileReader::wait_for_writer() {
    constexpr int kPatience_s = 10, kPerSecond = 100;
    for (int i = 0; i < kPatience_s * kPerSecond; ++i) {
        ::pollfd ready{descriptor_, POLLIN, 0};
        ::poll(&ready, 1, 1000 / kPerSecond);
        char byte = 0;
        const ssize_t got = ::read(descriptor_, &byte, 1);
        if (got == 1) first_ = byte;
        const bool is_there = got < 0 && errno == EAGAIN,
                   has_ended = (ready.revents & POLLHUP) != 0;
        if (got == 1 || is_there || has_ended) return;
    }
    fail("a pipe into which nobody has written for " + std::to_string(kPatience_s) + " s");
}

FileReader::~FileReader() { ::close(descriptor_); }

std::size_t FileReader::read(void* to, std::size_t count) {
    std::size_t used = 0;
    if (first_ && count > 0) {
        static_cast<char*>(to)[used++] = *first_;
        first_.reset();
    }
    while (used < count) {
        const ssize_t got = ::read(descriptor_, static_cast<char*>(to) + used, count - used);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) fail(reason());
        if (got == 0) break;
        used += static_cast<std::size_t>(got);
    }
    return used;
}

std::size_t FileReader::read_at(std::uint64_t from, void* to, std::size_t count) const {
    std::size_t used = 0;
    while (used < count) {
        const ssize_t got = ::pread(descriptor_, static_cast<char*>(to) + used, count - used,
                                    static_cast<off_t>(from + used));
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) fail(reason());
        if (got == 0) break;
        used += static_cast<std::size_t>(got);
    }
    return used;
}

void FileReader::check_type(unsigned mode) const {
    if (S_ISDIR(mode)) fail("a folder");
    if (!S_ISREG(mode) && !S_ISFIFO(mode)) fail("a device or socket");
}

void FileReader::fail_as_too_large(const std::string& found) const {
    throw Error(file_.string(),
                std::string(kind_.name) + " of at most " +
                    std::to_string(kind_.max_bytes / kMegabyte) + " MB",
                found);
}

void FileReader::fail(const std::string& found) const {
    throw Error(file_.string(), std::string(kind_.name), found);
}

}  // namespace risorius
