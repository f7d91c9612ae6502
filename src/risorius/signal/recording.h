// SPDX-License-Identifier: MIT
/// \file
/// A table of samples from a text file: a header line with the names of the columns, then one line per sample. Columns are
/// separated by tabs, semicolons or commas, whichever the header has. Lines that begin with # are skipped. A cell in double
/// quotes may contain the separator.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace risorius::signal {

/// The text of a file, split into cells. Cells are converted to numbers on request.
class Recording {
  public:
    /// Throws Error when the file cannot be read, when a column has no name or the name of another one, or when a line has too
    /// many or too few cells.
    static Recording read_file(const std::filesystem::path& file);

    const std::filesystem::path& file() const { return file_; }
    const std::vector<std::string>& columns() const { return columns_; }
    std::size_t sample_count() const { return lines_.size(); }

    /// Returns the index of a column; -1 when there is none of that name.
    int find(const std::string& column) const;

    /// Throws Error that names file, line and column of a value that is not a finite number.
    std::vector<double> samples(int column) const;

    /// The same, with NaN for values that are missing: empty cells, "n/a", "NA" and "NaN".
    std::vector<double> samples_or_nan(int column) const;

    /// Samples of a column in which values may be missing: empty cells, "n/a", "NA" and "NaN".
    struct Bridged {
        std::vector<double> samples;
        std::vector<std::string> notes;  ///< one when values were missing
    };
    /// Puts values on a straight line between the neighbours of a gap that lasts at most kLongestGap_s, and the nearest value at
    /// the ends of the file. `times_s` has the time of each line, s. Throws Error for a longer gap, and as samples() does.
    Bridged bridged_samples(int column, const std::vector<double>& times_s) const;

    /// Longest gap that is bridged, s. Half a period of 5 Hz, above which faces hardly move and envelopes of EMG have no power.
    static constexpr double kLongestGap_s = 0.1;

    /// Returns the sampling rate, Hz, from a column of times, s. Throws Error when times do not increase, or when a step differs
    /// from the usual one by more than half of it.
    double rate_hz(int time_column) const;

  private:
    struct Line {
        std::size_t number;  ///< line number in the file, from 1
        std::size_t begin, end;
    };
    std::string place(const Line& line, int column) const;
    std::string_view text_of(const Line& line) const;
    void read_header(std::string_view line, const std::string& place);
    /// The number in a cell; NaN when the value is missing and `may_miss` is set.
    double number(const Line& line, int column, bool may_miss) const;

    std::filesystem::path file_;
    std::string text_;
    char separator_ = ',';
    std::vector<std::string> columns_;
    std::vector<Line> lines_;
};

}  // namespace risorius::signal
