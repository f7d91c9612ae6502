// SPDX-License-Identifier: MIT
#include "risorius/signal/recording.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string_view>

#include "risorius/core/error.h"
#include "risorius/core/json_cursor.h"

namespace risorius::signal {

namespace {

std::string_view trimmed(std::string_view text) {
    const auto is_filler = [](char c) { return c == ' ' || c == '\r' || c == '"'; };
    while (!text.empty() && is_filler(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_filler(text.back())) text.remove_suffix(1);
    return text;
}

/// Calls `take` for the cells of a line, in order. Returns their number.
template <typename Take>
int for_each_cell(std::string_view line, char separator, Take take) {
    int column = 0;
    for (std::size_t begin = 0;; ++column) {
        const std::size_t end = line.find(separator, begin);
        take(column, trimmed(line.substr(begin, end - begin)));
        if (end == std::string_view::npos) return column + 1;
        begin = end + 1;
    }
}

}  // namespace

Recording Recording::read_file(const std::filesystem::path& file) {
    Recording recording;
    recording.file_ = file;
    std::ifstream stream(file, std::ios::binary);
    if (!stream) throw Error(file.string(), "a readable file", "none");
    std::ostringstream whole;
    whole << stream.rdbuf();
    recording.text_ = std::move(whole).str();

    const std::string_view text = recording.text_;
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";  // some spreadsheets write one
    std::size_t number = 0;
    for (std::size_t begin = text.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0;
         begin < text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        const std::string_view line = trimmed(text.substr(begin, end - begin));
        const Line here{++number, begin, end};
        begin = end + 1;
        if (line.empty() || line.front() == '#') continue;
        const std::string place = file.string() + ":" + std::to_string(number);
        if (recording.columns_.empty()) {
            for (const char separator : {'\t', ';', ','})
                if (line.find(separator) != std::string_view::npos) {
                    recording.separator_ = separator;
                    break;
                }
            for_each_cell(line, recording.separator_, [&](int, std::string_view name) {
                if (name.empty()) throw Error(place, "a name for every column", "an empty one");
                if (recording.find(std::string(name)) >= 0)
                    throw Error(place, "every column once", "\"" + std::string(name) + "\" again");
                recording.columns_.emplace_back(name);
            });
            continue;
        }
        const auto cells = 1 + std::count(line.begin(), line.end(), recording.separator_);
        if (cells != static_cast<std::ptrdiff_t>(recording.columns_.size()))
            throw Error(place, std::to_string(recording.columns_.size()) + " cells",
                        std::to_string(cells));
        recording.lines_.push_back(here);
    }
    if (recording.columns_.empty())
        throw Error(file.string(), "a line with the names of the columns", "none");
    return recording;
}

int Recording::find(const std::string& column) const {
    const auto found = std::find(columns_.begin(), columns_.end(), column);
    return found == columns_.end() ? -1 : static_cast<int>(found - columns_.begin());
}

std::string Recording::place(const Line& line, int column) const {
    return file_.string() + ":" + std::to_string(line.number) + ":" +
           columns_[static_cast<std::size_t>(column)];
}

std::vector<double> Recording::samples(int column) const {
    std::vector<double> samples;
    samples.reserve(lines_.size());
    for (const Line& line : lines_) {
        const std::string_view text =
            std::string_view(text_).substr(line.begin, line.end - line.begin);
        for_each_cell(text, separator_, [&](int at, std::string_view cell) {
            if (at != column) return;
            double value = 0;
            const auto [end, error] =
                std::from_chars(cell.data(), cell.data() + cell.size(), value);
            if (error != std::errc() || end != cell.data() + cell.size() || !std::isfinite(value))
                throw Error(place(line, column), "a number",
                            cell.empty() ? "nothing" : "\"" + std::string(cell) + "\"");
            samples.push_back(value);
        });
    }
    return samples;
}

double Recording::rate_hz(int time_column) const {
    const std::vector<double> times = samples(time_column);
    if (times.size() < 3)
        throw Error(file_.string(), "three samples or more", std::to_string(times.size()));
    std::vector<double> steps(times.size() - 1);
    for (std::size_t i = 0; i < steps.size(); ++i) steps[i] = times[i + 1] - times[i];
    std::vector<double> sorted = steps;
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    const double usual = *middle;
    for (std::size_t i = 0; i < steps.size(); ++i)
        if (!(usual > 0 && steps[i] > 0.5 * usual && steps[i] < 1.5 * usual))
            throw Error(place(lines_[i + 1], time_column),
                        usual > 0 ? "a time " + format_number(usual) + " s after the one before"
                                  : "times that grow",
                        format_number(steps[i]) + " s after it");
    return static_cast<double>(steps.size()) / (times.back() - times.front());
}

}  // namespace risorius::signal
