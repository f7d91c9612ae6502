// SPDX-License-Identifier: MIT
/// \file
/// A folder of results that is written completely or not at all. Below the private folder of an OutputSet it is filled straight
/// away, and the set decides about it. Any other is a set of its own, which commit() commits.
///
/// An earlier folder of results is replaced. It is recognized by its results.json, which lists its files; a folder with any other
/// file is rejected.
#pragma once

#include <filesystem>
#include <optional>

#include "risorius/core/output_set.h"

namespace risorius::report {

class AtomicFolder {
  public:
    /// Throws Error when `folder` cannot be made, or when it exists and has files that are not results.
    explicit AtomicFolder(const std::filesystem::path& folder,
                          OutputSet::Then then = OutputSet::Then::kRunEnds);
    AtomicFolder(const AtomicFolder&) = delete;
    AtomicFolder& operator=(const AtomicFolder&) = delete;

    /// Returns the folder to write to before commit().
    const std::filesystem::path& partial() const { return partial_; }

    /// Throws RunError when the folder cannot be renamed; then the earlier folder stays.
    void commit();

  private:
    std::filesystem::path folder_, partial_;
    std::optional<OutputSet> own_;  ///< none when the folder belongs to a set of the caller
};

/// Throws Error when the folder exists and has files that are not results.
void check_results_folder(const std::filesystem::path& folder);

/// The path of a folder of results without links and final slash. What is written is what links name.
std::filesystem::path real_results_folder(const std::filesystem::path& folder);

/// The key of results.json whose value lists all files of the folder, results.json included.
inline constexpr const char* kFilesKey = "files";

}  // namespace risorius::report
