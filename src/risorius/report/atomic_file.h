// SPDX-License-Identifier: MIT
/// \file
/// A text file that appears whole or not at all. It is written at once under another name in the same folder; commit() gives it its
/// own name.
#pragma once

#include <filesystem>
#include <string>

namespace risorius::report {

class AtomicFile {
  public:
    /// Throws RunError when it cannot be written. Missing folders are made.
    AtomicFile(const std::filesystem::path& file, const std::string& text);
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    void commit();

  private:
    std::filesystem::path file_, partial_;
};

/// Writes one file whole or not at all. Throws RunError.
void write_text(const std::filesystem::path& file, const std::string& text);

}  // namespace risorius::report
