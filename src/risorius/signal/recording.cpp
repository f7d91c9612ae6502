// SPDX-License-Identifier: MIT
#include "risorius/signal/recording.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>

#include "risorius/core/error.h"
#include "risorius/core/json_cursor.h"
#include "risorius/core/text_lines.h"

namespace risorius::signal {

namespace {

constexpr FileKind kRecording{"a recording", 2000 * kMegabyte};
constexpr std::size_t kMostColumns = 5000;  // each is compared with all others

std::string_view trimmed(std::string_view text) {
    const auto is_filler = [](char c) { return c == ' ' || c == '\t'; };
    while (!text.empty() && is_filler(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_filler(text.back())) text.remove_suffix(1);
    return text;
}

/// Takes the next cell from the front of `line`, without the quotes around it. `line` becomes the rest behind the separator.
/// Returns false when it was the last one. Throws Error.
bool take_cell(std::string_view& line, char separator, std::string& cell,
               const std::string& place) {
    cell.clear();
    std::size_t at = 0;
    while (at < line.size() && line[at] == ' ') ++at;
    if (at < line.size() && line[at] == '"') {
        for (++at;; ++at) {
            if (at >= line.size()) throw Error(place, "a closing quote", "the end of the line");
            if (line[at] != '"')
                cell += line[at];
            else if (at + 1 < line.size() && line[at + 1] == '"')
                cell += line[++at];
            else
                break;
        }
        ++at;
    } else {
        at = 0;
    }
    const std::size_t end = std::min(line.find(separator, at), line.size());
    cell += trimmed(line.substr(at, end - at));
    if (cell.empty() || cell.front() == ' ' || cell.back() == ' ') cell = trimmed(cell);
    if (end == line.size()) return false;
    line.remove_prefix(end + 1);
    return true;
}

/// Whether a cell says that there is no value, as tables of BIDS, spreadsheets, R and pandas write it.
bool says_missing(std::string_view cell) {
    constexpr std::array<std::string_view, 5> kWords{"", "n/a", "na", "nan", "#n/a"};
    return std::any_of(kWords.begin(), kWords.end(), [&](std::string_view word) {
        return std::equal(cell.begin(), cell.end(), word.begin(), word.end(), [](char a, char b) {
            return (a >= 'A' && a <= 'Z' ? static_cast<char>(a - 'A' + 'a') : a) == b;
        });
    });
}

/// Whether text is a number with a decimal comma: "1,5".
bool has_decimal_comma(std::string_view cell) {
    const std::size_t comma = cell.find(',');
    const auto is_digit = [&](std::size_t i) {
        return i < cell.size() && cell[i] >= '0' && cell[i] <= '9';
    };
    return comma != std::string_view::npos && comma > 0 && is_digit(comma - 1) &&
           is_digit(comma + 1) && cell.find(',', comma + 1) == std::string_view::npos;
}

}  // namespace

void Recording::read_header(std::string_view line, const std::string& place) {
    for (const char separator : {'\t', ';', ','})
        if (line.find(separator) != std::string_view::npos) {
            separator_ = separator;
            break;
        }
    std::string name;
    for (bool more = true; more;) {
        more = take_cell(line, separator_, name, place);
        if (name.empty()) throw Error(place, "a name for every column", "an empty one");
        if (columns_.size() == kMostColumns) throw Error(place, "at most 5000 columns", "more");
        if (find(name) >= 0) throw Error(place, "every column once", "\"" + name + "\" again");
        columns_.push_back(name);
    }
}

Recording Recording::read_file(const std::filesystem::path& file) {
    Recording recording;
    recording.file_ = file;
    recording.text_ = read_text(file, kRecording);
    std::string cell;
    for (TextLines lines(recording.text_); lines.next();) {
        std::string_view line = lines.line();
        const std::string_view content = trimmed(line);
        // A row of empty cells is a row; a line without anything is none.
        const bool is_row = !content.empty() || line.find(recording.separator_) < line.size();
        if (!is_row || content.starts_with('#') || content.starts_with("\"#")) continue;
        const auto place = [&] { return file.string() + ":" + std::to_string(lines.number()); };
        if (recording.columns_.empty()) {
            if (!content.empty()) recording.read_header(line, place());
            continue;
        }
        std::size_t cells = 0;
        if (line.find('"') == std::string_view::npos)
            cells = 1 + static_cast<std::size_t>(
                            std::count(line.begin(), line.end(), recording.separator_));
        else
            for (bool more = true; more; ++cells)
                more = take_cell(line, recording.separator_, cell, place());
        if (cells != recording.columns_.size())
            throw Error(place(), std::to_string(recording.columns_.size()) + " cells",
                        std::to_string(cells) +
                            (recording.separator_ == ',' && cells == 2 * recording.columns_.size()
                                 ? "; a comma separates cells, so that numbers need a decimal point"
                                 : ""));
        recording.lines_.push_back(
            {lines.number(), lines.begin(), lines.begin() + lines.line().size()});
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

std::string_view Recording::text_of(const Line& line) const {
    return std::string_view(text_).substr(line.begin, line.end - line.begin);
}

double Recording::number(const Line& line, int column, bool may_miss) const {
    std::string_view text = text_of(line);
    std::string cell;
    for (int c = 0; c <= column; ++c) take_cell(text, separator_, cell, "");
    if (says_missing(cell) && may_miss) return std::numeric_limits<double>::quiet_NaN();
    const char* begin = cell.data();
    const char* const end = cell.data() + cell.size();
    if (cell.size() > 1 && cell[0] == '+' && cell[1] != '-' && cell[1] != '+') ++begin;
    double value = 0;
    const auto [stop, error] = std::from_chars(begin, end, value);
    if (error == std::errc() && stop == end && std::isfinite(value)) return value;
    if (has_decimal_comma(cell))
        throw Error(place(line, column), "a number with a decimal point", "\"" + cell + "\"");
    throw Error(place(line, column), "a number", cell.empty() ? "nothing" : "\"" + cell + "\"");
}

std::vector<double> Recording::samples(int column) const {
    std::vector<double> samples;
    samples.reserve(lines_.size());
    for (const Line& line : lines_) samples.push_back(number(line, column, false));
    return samples;
}

std::vector<double> Recording::samples_or_nan(int column) const {
    std::vector<double> samples;
    for (const Line& line : lines_) samples.push_back(number(line, column, true));
    return samples;
}

Recording::Bridged Recording::bridged_samples(int column,
                                              const std::vector<double>& times_s) const {
    Bridged out;
    out.samples.reserve(lines_.size());
    for (const Line& line : lines_) out.samples.push_back(number(line, column, true));
    const std::size_t count = out.samples.size();
    std::size_t missing = 0;
    double longest_s = 0;
    for (std::size_t first = 0; first < count; ++first) {
        if (!std::isnan(out.samples[first])) continue;
        std::size_t end = first;
        while (end < count && std::isnan(out.samples[end])) ++end;
        if (first == 0 && end == count)
            throw Error(place(lines_[0], column), "a number in some row", "none");
        // From the last value before the gap to the first one after it, less the usual step
        const std::size_t before = first == 0 ? 0 : first - 1, after = end == count ? end - 1 : end;
        const double step_s = (times_s.back() - times_s.front()) /
                              static_cast<double>(std::max<std::size_t>(count, 2) - 1);
        const double lasts_s =
            times_s[after] - times_s[before] - (first == 0 || end == count ? 0 : step_s);
        if (lasts_s > kLongestGap_s + 1e-9)
            throw Error(place(lines_[first], column),
                        "gaps of at most " + format_number(kLongestGap_s) + " s",
                        "one of " + format_number(std::round(1e6 * lasts_s) / 1e6) + " s, " +
                            std::to_string(end - first) + " rows");
        for (std::size_t i = first; i < end; ++i) {
            const double left = out.samples[first == 0 ? end : before],
                         right = out.samples[end == count ? before : end];
            const double part = first == 0 || end == count ? 0
                                                           : (times_s[i] - times_s[before]) /
                                                                 (times_s[end] - times_s[before]);
            out.samples[i] = left + part * (right - left);
        }
        missing += end - first;
        longest_s = std::max(longest_s, lasts_s);
        first = end;
    }
    if (missing > 0)
        out.notes.push_back(file_.string() + ": " + std::to_string(missing) +
                            (missing == 1 ? " value" : " values") + " of \"" +
                            columns_[static_cast<std::size_t>(column)] +
                            "\" are missing and bridged, at most " +
                            format_number(std::round(1e6 * longest_s) / 1e6) + " s in a row");
    return out;
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
