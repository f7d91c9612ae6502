// SPDX-License-Identifier: MIT
/// \file
/// A folder of results that is written completely or not at all. It is filled under another name next to its final place;
/// commit() renames it.
///
/// An earlier folder of results is replaced. It is recognized by its results.json, which lists its files; a folder with any other
/// file is rejected.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace risorius::report {

class AtomicFolder {
  public:
    /// Throws Error when `folder` cannot be made, or when it exists and has files that are not results.
    explicit AtomicFolder(const std::filesystem::path& folder);
    ~AtomicFolder();
    AtomicFolder(const AtomicFolder&) = delete;
    AtomicFolder& operator=(const AtomicFolder&) = delete;

    /// Returns the folder to write to before commit().
    const std::filesystem::path& partial() const { return partial_; }

    /// Throws RunError when the folder cannot be renamed; then the earlier folder stays.
    void commit();

  private:
    std::filesystem::path folder_, partial_;
    std::vector<std::filesystem::path> made_;  ///< parent folders that were made, outermost first
    bool committed_ = false;
};

/// The key of results.json whose value lists all files of the folder, results.json included.
inline constexpr const char* kFilesKey = "files";

}  // namespace risorius::report
