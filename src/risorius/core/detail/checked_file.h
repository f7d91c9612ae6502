// SPDX-License-Identifier: MIT
/// \file
/// Calls of the operating system for files that are written, each of them checked.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace risorius::detail {

/// A file descriptor that is closed with this object. -1: none.
class Descriptor {
  public:
    explicit Descriptor(int value = -1) : value_(value) {}
    ~Descriptor() { close(); }
    Descriptor(Descriptor&& other) noexcept : value_(other.value_) { other.value_ = -1; }
    Descriptor& operator=(Descriptor&& other) noexcept;
    int get() const { return value_; }
    explicit operator bool() const { return value_ >= 0; }
    int close();  ///< returns what close() does, 0 without a descriptor

  private:
    int value_;
};

/// open() that is repeated after signals. Links in the last part of the path are not followed.
Descriptor open_file(const std::filesystem::path& file, int flags, int mode = 0666);

/// "PLACE: cannot be written: REASON" with the reason of errno, as RunError.
[[noreturn]] void fail_to_write(const std::filesystem::path& place);

/// Writes all bytes. Throws RunError that names `place`.
void write_all(const Descriptor& out, std::string_view bytes, const std::filesystem::path& place);

/// Creates a file, which must not exist, and writes it. With `sync`, it is on the disk afterwards. Throws RunError.
void write_new_file(const std::filesystem::path& file, std::string_view bytes, bool sync,
                    const std::filesystem::path& place);

/// Brings a file or folder to the disk. File systems that cannot are ignored. Throws RunError.
void sync_path(const std::filesystem::path& path, const std::filesystem::path& place);

/// Brings a file, or a folder with everything in it, to the disk. Throws RunError.
void sync_tree(const std::filesystem::path& path, const std::filesystem::path& place);

}  // namespace risorius::detail
