// SPDX-License-Identifier: MIT
/// \file
/// A folder of results that appears whole or not at all. It is filled under another name beside its place; commit() gives it its own
/// name.
///
/// An earlier folder of results is replaced. It is recognised by its results.json, which lists its files: a folder with any other
/// file is refused.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace risorius::report {

class AtomicFolder {
  public:
    /// Throws Error when `folder` cannot be made, or exists and holds other files than results.
    explicit AtomicFolder(const std::filesystem::path& folder);
    ~AtomicFolder();
    AtomicFolder(const AtomicFolder&) = delete;
    AtomicFolder& operator=(const AtomicFolder&) = delete;

    /// Where to write until commit().
    const std::filesystem::path& partial() const { return partial_; }

    /// Throws RunError when the folder cannot be renamed; the earlier folder then stays.
    void commit();

  private:
    std::filesystem::path folder_, partial_;
    std::vector<std::filesystem::path> made_;  ///< parents, outermost first
    bool committed_ = false;
};

/// The key of results.json that lists all files of the folder, itself included.
inline constexpr const char* kFilesKey = "files";

}  // namespace risorius::report
