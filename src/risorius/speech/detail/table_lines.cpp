// SPDX-License-Identifier: MIT
#include "risorius/speech/detail/table_lines.h"

#include <charconv>
#include <cmath>

#include "risorius/core/error.h"
#include "risorius/core/text_lines.h"

namespace risorius::speech {

namespace {

constexpr FileKind kTable{"a table", 4 * kMegabyte};
constexpr std::string_view kBlank = " \t\r\v\f";

}  // namespace

std::vector<std::string> cells_of(std::string_view line, char separator) {
    std::vector<std::string> cells;
    for (;;) {
        const std::size_t end = line.find(separator);
        cells.emplace_back(line.substr(0, end));
        if (end == std::string_view::npos) return cells;
        line.remove_prefix(end + 1);
    }
}

std::vector<std::string> words_of(std::string_view line) {
    std::vector<std::string> words;
    for (std::size_t begin = line.find_first_not_of(kBlank); begin < line.size();) {
        const std::size_t end = std::min(line.find_first_of(kBlank, begin), line.size());
        words.emplace_back(line.substr(begin, end - begin));
        begin = line.find_first_not_of(kBlank, end);
    }
    return words;
}

std::string trimmed(std::string_view text) {
    const std::size_t begin = text.find_first_not_of(kBlank);
    if (begin == std::string_view::npos) return "";
    return std::string(text.substr(begin, text.find_last_not_of(kBlank) - begin + 1));
}

double number_in(std::string_view text, const std::string& place, const std::string& expected) {
    if (text.starts_with('+')) text.remove_prefix(1);
    double value = 0;
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (code != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
        throw Error(place, expected, in_quotes(shortened_text(text, 60)));
    return value;
}

std::string line_place(const std::string& file, std::size_t line) {
    return file + ":" + std::to_string(line);
}

double TableLine::number(std::size_t column) const {
    return number_in(cells[column], place, "a number");
}

std::vector<TableLine> read_table_lines(const std::filesystem::path& file,
                                        const std::vector<std::string>& columns) {
    const std::string text = read_text(file, kTable);
    std::vector<TableLine> out;
    bool named = false;
    for (TextLines lines(text); lines.next();) {
        if (lines.line().empty() || lines.line().starts_with('#')) continue;
        TableLine line{cells_of(lines.line(), '\t'), line_place(file.string(), lines.number())};
        if (!named) {
            std::string expected;
            for (const std::string& name : columns)
                expected += (expected.empty() ? "" : " ") + name;
            if (line.cells != columns)
                throw Error(line.place, "the columns " + expected,
                            in_quotes(shortened_text(lines.line(), 200)));
            named = true;
            continue;
        }
        if (line.cells.size() != columns.size())
            throw Error(line.place, std::to_string(columns.size()) + " cells",
                        std::to_string(line.cells.size()));
        out.push_back(std::move(line));
    }
    if (!named) throw Error(file.string(), "a line with the names of the columns", "none");
    return out;
}

}  // namespace risorius::speech
