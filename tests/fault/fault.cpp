// SPDX-License-Identifier: MIT
// A library for LD_PRELOAD. It counts the operations on files below a folder, and lets one of them fail or ends the process there.
//
//   FAULT_BELOW   the folder; operations elsewhere are not counted
//   FAULT_AT      the number of the operation, from 1
//   FAULT_ERROR   the value of errno with which it fails
//   FAULT_SIGNAL  or the signal that the process gets before it
//   FAULT_KIND    only operations of this kind are counted, such as "rename"
//   FAULT_LOG     a file to which each operation is appended
//
//   FAULT_EACH, ...   see fault_each.h
//   FAULT_THREAD_FROM   apart from that: no thread is started from the one with this number on
#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <stdarg.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <climits>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "fault_each.h"

namespace {

std::atomic<int> count{0};
thread_local bool inside = false;  // the functions of this file use files themselves

template <class Function>
Function real(const char* name) {
    return reinterpret_cast<Function>(::dlsym(RTLD_NEXT, name));
}

bool is_below(const char* path) {
    const char* folder = std::getenv("FAULT_BELOW");
    if (!folder || !path) return false;
    char whole[2 * PATH_MAX] = "";
    if (path[0] != '/') {
        if (!::getcwd(whole, PATH_MAX)) return false;
        std::strcat(whole, "/");
    }
    std::strncat(whole, path, PATH_MAX);
    return std::strncmp(whole, folder, std::strlen(folder)) == 0;
}

bool is_below(int descriptor, char (&path)[PATH_MAX]) {
    char link[64];
    std::snprintf(link, sizeof link, "/proc/self/fd/%d", descriptor);
    const ssize_t length = ::readlink(link, path, PATH_MAX - 1);
    if (length < 0) return false;
    path[length] = 0;
    return is_below(path);
}

void log(int number, const char* kind, const char* path) {
    const char* file = std::getenv("FAULT_LOG");
    if (!file) return;
    inside = true;
    char line[PATH_MAX + 64];
    const int length = std::snprintf(line, sizeof line, "%d %s %s\n", number, kind, path);
    const int out = ::open(file, O_WRONLY | O_CREAT | O_APPEND, 0600);
    if (out >= 0 && ::write(out, line, static_cast<std::size_t>(length)) < 0) ::perror(file);
    ::close(out);
    inside = false;
}

/// Whether this operation is to fail; errno is then set.
bool fails(const char* kind, const char* path) {
    if (inside) return false;
    if (const char* only = std::getenv("FAULT_KIND"); only && std::strcmp(only, kind) != 0)
        return false;
    if (risorius::fault::is_copy()) return false;  // it has had its fault
    const int number = ++count;
    log(number, kind, path);
    if (risorius::fault::tries_each()) {
        inside = true;
        const int error = risorius::fault::try_each(number);
        inside = false;
        errno = error;
        return error != 0;
    }
    const char* at = std::getenv("FAULT_AT");
    if (!at || number != std::atoi(at)) return false;
    if (const char* signal = std::getenv("FAULT_SIGNAL")) {
        ::kill(::getpid(), std::atoi(signal));
        return false;
    }
    const char* error = std::getenv("FAULT_ERROR");
    errno = error ? std::atoi(error) : EIO;
    return true;
}

/// As above, for an operation on an open file.
bool fails(const char* kind, int descriptor) {
    char path[PATH_MAX];
    return !inside && descriptor > STDERR_FILENO && is_below(descriptor, path) && fails(kind, path);
}

using Open = int (*)(const char*, int, ...);

int open_with(Open open, const char* path, int flags, mode_t mode) {
    if (is_below(path) && fails((flags & O_ACCMODE) == O_RDONLY ? "open to read" : "open", path))
        return -1;
    return open(path, flags, mode);
}

}  // namespace

extern "C" {

int open(const char* path, int flags, ...) {
    static const auto next = real<Open>("open");
    va_list rest;
    va_start(rest, flags);
    const mode_t mode = (flags & (O_CREAT | O_TMPFILE)) ? va_arg(rest, mode_t) : 0;
    va_end(rest);
    return open_with(next, path, flags, mode);
}

int open64(const char* path, int flags, ...) {
    static const auto next = real<Open>("open64");
    va_list rest;
    va_start(rest, flags);
    const mode_t mode = (flags & (O_CREAT | O_TMPFILE)) ? va_arg(rest, mode_t) : 0;
    va_end(rest);
    return open_with(next, path, flags, mode);
}

ssize_t write(int file, const void* bytes, size_t size) {
    static const auto next = real<ssize_t (*)(int, const void*, size_t)>("write");
    return fails("write", file) ? -1 : next(file, bytes, size);
}

ssize_t read(int file, void* bytes, size_t size) {
    static const auto next = real<ssize_t (*)(int, void*, size_t)>("read");
    return fails("read", file) ? -1 : next(file, bytes, size);
}

int close(int file) {
    static const auto next = real<int (*)(int)>("close");
    const bool failed = (::fcntl(file, F_GETFL) & O_ACCMODE) != O_RDONLY && fails("close", file);
    const int error = errno, result = next(file);
    if (!failed) return result;
    errno = error;
    return -1;
}

int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*work)(void*),
                   void* argument) noexcept {
    static const auto next =
        real<int (*)(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*)>("pthread_create");
    static std::atomic<int> started{0};
    const char* from = std::getenv("FAULT_THREAD_FROM");
    if (from && ++started >= std::atoi(from)) return EAGAIN;
    return next(thread, attributes, work, argument);
}

int fsync(int file) {
    static const auto next = real<int (*)(int)>("fsync");
    return fails("fsync", file) ? -1 : next(file);
}

int syncfs(int file) noexcept {
    static const auto next = real<int (*)(int)>("syncfs");
    return fails("fsync", file) ? -1 : next(file);
}

int rename(const char* from, const char* to) noexcept {
    static const auto next = real<int (*)(const char*, const char*)>("rename");
    return is_below(to) && fails("rename", to) ? -1 : next(from, to);
}

int renameat2(int a, const char* from, int b, const char* to, unsigned flags) noexcept {
    static const auto next =
        real<int (*)(int, const char*, int, const char*, unsigned)>("renameat2");
    return is_below(to) && fails("rename", to) ? -1 : next(a, from, b, to, flags);
}

int mkdir(const char* path, mode_t mode) noexcept {
    static const auto next = real<int (*)(const char*, mode_t)>("mkdir");
    return is_below(path) && fails("mkdir", path) ? -1 : next(path, mode);
}

char* mkdtemp(char* path) noexcept {
    static const auto next = real<char* (*)(char*)>("mkdtemp");
    return is_below(path) && fails("mkdir", path) ? nullptr : next(path);
}

int unlink(const char* path) noexcept {
    static const auto next = real<int (*)(const char*)>("unlink");
    return is_below(path) && fails("unlink", path) ? -1 : next(path);
}

}  // extern "C"
