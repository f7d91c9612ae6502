// SPDX-License-Identifier: MIT
/// \file
/// Writes output under a temporary name next to its target, so that an incomplete result never has the target's name.
#pragma once

#include <filesystem>
#include <vector>

namespace risorius::media::detail {

/// Reserves ".<name>.part-<process>-<n>" in the target's folder, making that folder and its parents
/// when missing. Until replace_target() has run, the destructor removes the temporary file or
/// folder and the parents it made.
class TemporaryFile {
  public:
    /// Throws Error when a parent is not a folder, RunError when it cannot be made.
    explicit TemporaryFile(const std::filesystem::path& target);
    ~TemporaryFile();
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;

    const std::filesystem::path& path() const { return path_; }

    /// Renames onto the target; a file or a folder that stood there is replaced. Throws RunError.
    void replace_target();

  private:
    std::filesystem::path target_;
    std::filesystem::path path_;
    std::vector<std::filesystem::path> made_;  ///< parents made here, outermost first
    bool kept_ = false;
};

/// Writes the bytes under a temporary name and renames. Throws RunError, leaving what was there
/// before.
void write_whole(const std::filesystem::path& file, const void* bytes, std::size_t count);

/// A file's bytes. Throws Error when it is missing, a folder or cannot be read.
std::vector<unsigned char> read_whole(const std::filesystem::path& file, const char* expected);

}  // namespace risorius::media::detail
