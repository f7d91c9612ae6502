// SPDX-License-Identifier: MIT
/// \file
/// The checksums of the files that a thread reads, of the very bytes that it gets.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "risorius/animate/detail/run_record.h"
#include "risorius/core/read_observer.h"

namespace risorius::animate {

/// Make one before the files are read, and ask it after that. Throws RunError in the reader when a file is read twice and has
/// changed in between.
class ReadChecksums {
  public:
    ReadChecksums();

    /// Files that another process or a library reads, such as those of the mesh importer, are not seen. For these the checksum is
    /// that of the file at the time of the first of these calls.
    InputFile of(const std::filesystem::path& file);

  private:
    void note(const std::filesystem::path& file, const std::string& sha256);

    std::map<std::filesystem::path, std::string> sums_;
    ReadObserver observer_;
};

}  // namespace risorius::animate
