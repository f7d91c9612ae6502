// SPDX-License-Identifier: MIT
/// \file
/// Writes output under a temporary name next to its target, so that an incomplete file never has the target's name.
#pragma once

#include <filesystem>
#include <vector>

namespace risorius::media::detail {

/// Reserves ".<name>.part-<process>-<n>" in the target's folder. That folder and its parents are made when they are missing.
/// Unless replace_target() has run, the destructor removes the temporary file or folder and the parents it made.
class TemporaryFile {
  public:
    /// Throws Error when a parent is not a folder, and RunError when a folder cannot be made.
    explicit TemporaryFile(const std::filesystem::path& target);
    ~TemporaryFile();
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;

    const std::filesystem::path& path() const { return path_; }

    /// Renames the temporary file or folder to the target, which it replaces. Throws RunError.
    void replace_target();

  private:
    std::filesystem::path target_;
    std::filesystem::path path_;
    std::vector<std::filesystem::path> made_;  ///< parents made here, outermost first
    bool kept_ = false;
};

/// Writes the bytes to a file under a temporary name and then renames it. When this fails, it throws RunError and the old file is
/// unchanged.
void write_whole(const std::filesystem::path& file, const void* bytes, std::size_t count);

/// Returns the bytes of a file. Throws Error when it is missing, is a folder or cannot be read; `expected` is part of the
/// message.
std::vector<unsigned char> read_whole(const std::filesystem::path& file, const char* expected);

}  // namespace risorius::media::detail
