// SPDX-License-Identifier: MIT
/// \file
/// A table of samples from a text file: a header line with the names of the columns, then one line per sample. Columns are
/// separated by tabs, semicolons or commas, whichever the header has. Lines that begin with # are skipped.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace risorius::signal {

/// The text of a file, split into cells. Cells are converted to numbers on request.
class Recording {
  public:
    /// Throws Error when the file is missing, when a column has no name or the name of another one, or when a line has too many
    /// or too few cells.
    static Recording read_file(const std::filesystem::path& file);

    const std::filesystem::path& file() const { return file_; }
    const std::vector<std::string>& columns() const { return columns_; }
    std::size_t sample_count() const { return lines_.size(); }

    /// Returns the index of a column; -1 when there is none of that name.
    int find(const std::string& column) const;

    /// Throws Error that names file, line and column of a value that is not a finite number.
    std::vector<double> samples(int column) const;

    /// Returns the sampling rate, Hz, from a column of times, s. Throws Error when times do not increase, or when a step differs
    /// from the usual one by more than half of it.
    double rate_hz(int time_column) const;

  private:
    struct Line {
        std::size_t number;  ///< line number in the file, from 1
        std::size_t begin, end;
    };
    std::string place(const Line& line, int column) const;

    std::filesystem::path file_;
    std::string text_;
    char separator_ = ',';
    std::vector<std::string> columns_;
    std::vector<Line> lines_;
};

}  // namespace risorius::signal
