// SPDX-License-Identifier: MIT
/// \file
/// Tables of text with tabs between their cells: lines that begin with # are comments, and the first other line names the columns.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace risorius::speech {

/// The cells of a line between separators. There is at least one.
std::vector<std::string> cells_of(std::string_view line, char separator);
/// The words of a line between spaces and tabs.
std::vector<std::string> words_of(std::string_view line);
/// The text without spaces and tabs at its ends.
std::string trimmed(std::string_view text);

/// One line of a table with its place.
struct TableLine {
    std::vector<std::string> cells;
    std::string place;                        ///< "file:12"
    double number(std::size_t column) const;  ///< throws Error
};

/// Reads a table with exactly these columns. Throws Error that names file and line.
std::vector<TableLine> read_table_lines(const std::filesystem::path& file,
                                        const std::vector<std::string>& columns);

/// A finite number that fills the whole text. Throws Error with `place`.
double number_in(std::string_view text, const std::string& place, const std::string& expected);

/// "file:12"
std::string line_place(const std::string& file, std::size_t line);

}  // namespace risorius::speech
