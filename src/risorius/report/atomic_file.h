// SPDX-License-Identifier: MIT
/// \file
/// A text file that is written completely or not at all. The constructor writes it under another name in the same folder;
/// commit() renames it.
#pragma once

#include <filesystem>
#include <string>

namespace risorius::report {

class AtomicFile {
  public:
    /// Writes the temporary file, and makes missing folders. Throws RunError when it cannot be written.
    AtomicFile(const std::filesystem::path& file, const std::string& text);
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    /// Gives the file its name. Without this call, the destructor removes the temporary file.
    void commit();

  private:
    std::filesystem::path file_, partial_;
};

/// Writes a file completely or not at all. Throws RunError.
void write_text(const std::filesystem::path& file, const std::string& text);

}  // namespace risorius::report
