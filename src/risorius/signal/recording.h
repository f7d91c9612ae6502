// A table of samples from a text file: a header line with the names of the columns, then a line per sample. Columns are
// separated by tabs, semicolons or commas, whichever the header has; lines that begin with # are skipped.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace risorius::signal {

class Recording {
  public:
    /// Throws Error on a missing file, a column without name or named twice, or a line with too many or too few cells.
    static Recording read_file(const std::filesystem::path& file);

    const std::filesystem::path& file() const { return file_; }
    const std::vector<std::string>& columns() const { return columns_; }
    std::size_t sample_count() const { return lines_.size(); }

    /// -1 when there is none.
    int find(const std::string& column) const;

    /// Throws Error naming file, line and column of what is not a finite number.
    std::vector<double> samples(int column) const;

    /// Rate of samples whose times, s, stand in a column. Throws Error where time stands still, runs back, or leaves more
    /// or less than half of the usual step out.
    double rate_hz(int time_column) const;

  private:
    struct Line {
        std::size_t number;  ///< in the file, from 1
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
