// SPDX-License-Identifier: MIT
/// \file
/// Text files as editors, spreadsheets and recorders write them.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "risorius/core/read_file.h"

namespace risorius {

/// The text of a file without the byte-order mark of UTF-8 that some spreadsheets write. Throws Error as read_file() does, and
/// for text in UTF-16 or UTF-32, which the message names.
std::string read_text(const std::filesystem::path& file, const FileKind& kind);

/// As read_text(), for bytes that are in memory. `name` is the place in messages.
std::string text_of_bytes(std::string bytes, const std::string& name);

/// Goes through the lines of a text. A line ends with LF, CR LF, or CR alone. The text must outlive this object.
///
///   for (TextLines lines(text); lines.next();) use(lines.number(), lines.line());
class TextLines {
  public:
    explicit TextLines(std::string_view text) : text_(text) {}

    /// Goes to the next line, at first to the first one. Returns false at the end of the text. A line break at the end of the
    /// text does not begin another line.
    bool next();
    std::string_view line() const {
        return text_.substr(begin_, end_ - begin_);
    }                                               ///< without its line break
    std::size_t number() const { return number_; }  ///< counted from 1
    std::size_t begin() const { return begin_; }    ///< place of the line in the text, bytes

  private:
    std::string_view text_;
    std::size_t begin_ = 0, end_ = 0, next_ = 0, number_ = 0;
};

}  // namespace risorius
