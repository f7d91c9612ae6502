// A folder of results that appears whole or not at all: filled beside its place, named by commit().
//
// A former folder of results is replaced, and told from any other by its results.json, which lists its files: a folder
// with one file more is somebody's own and refused.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace risorius::report {

class AtomicFolder {
  public:
    /// Throws Error when `folder` is there and is neither empty nor results only, or cannot be made.
    explicit AtomicFolder(const std::filesystem::path& folder);
    ~AtomicFolder();
    AtomicFolder(const AtomicFolder&) = delete;
    AtomicFolder& operator=(const AtomicFolder&) = delete;

    /// Where to write until commit().
    const std::filesystem::path& partial() const { return partial_; }

    /// Throws RunError when it cannot take its place; the former folder then stays.
    void commit();

  private:
    std::filesystem::path folder_, partial_;
    std::vector<std::filesystem::path> made_;  ///< parents, outermost first
    bool committed_ = false;
};

/// The name under which results.json lists every file beside and below it, itself included.
inline constexpr const char* kFilesKey = "files";

}  // namespace risorius::report
