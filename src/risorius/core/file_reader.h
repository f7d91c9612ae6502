// SPDX-License-Identifier: MIT
/// \file
/// An open file that is read piece by piece, for files that are too large for read_file(). It gives the same guarantees, see
/// read_file.h: regular files and pipes only, a greatest size, and no read error that is taken for the end of the file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "risorius/core/read_file.h"

namespace risorius {

class FileReader {
  public:
    /// Throws Error with the path as its place. Of a pipe that nobody has opened to write, it waits 10 s for a writer.
    FileReader(const std::filesystem::path& file, const FileKind& kind);
    ~FileReader();
    FileReader(const FileReader&) = delete;
    FileReader& operator=(const FileReader&) = delete;

    bool is_regular() const { return regular_; }
    std::uint64_t size() const { return size_; }  ///< bytes of a regular file; 0 of a pipe

    /// Reads the next bytes. Returns their number, which is below `count` only at the end of the file. Throws Error.
    std::size_t read(void* to, std::size_t count);
    /// Does the same from a place in a regular file, and does not move where read() goes on.
    std::size_t read_at(std::uint64_t from, void* to, std::size_t count) const;

    /// Throws Error: more bytes were found than the kind allows.
    [[noreturn]] void fail_as_too_large(const std::string& found) const;

  private:
    void check_type(unsigned mode) const;
    void wait_for_writer();
    [[noreturn]] void fail(const std::string& found) const;

    std::filesystem::path file_;
    FileKind kind_;
    int descriptor_ = -1;
    bool regular_ = false;
    std::uint64_t size_ = 0;
    std::optional<char>
        first_;  ///< byte of a pipe that has been read to see whether it has a writer
};

}  // namespace risorius
