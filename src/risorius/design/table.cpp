// SPDX-License-Identifier: MIT
#include "risorius/design/table.h"

#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "risorius/core/error.h"
#include "risorius/core/text_lines.h"

namespace risorius::design {

namespace {

constexpr FileKind kTable{"a table of conditions", 100 * kMegabyte};

/// The cells of a file, by rows. A cell in double quotes may contain the separator, line breaks, and quotes that are written twice.
std::vector<std::pair<int, std::vector<std::string>>> cells_of(const std::string& text,
                                                               const std::string& place) {
    const std::size_t first_end = text.find_first_of("\r\n");
    const char separator = text.substr(0, first_end).find('\t') != std::string::npos ? '\t' : ',';
    std::vector<std::pair<int, std::vector<std::string>>> rows;
    std::vector<std::string> row;
    std::string cell;
    int line = 1, row_line = 1;
    bool quoted_cell = false;
    const auto end_row = [&] {
        row.push_back(std::move(cell));
        cell.clear();
        if (row.size() > 1 || !row[0].empty()) rows.emplace_back(row_line, std::move(row));
        row.clear();
        row_line = line + 1;
    };
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (quoted_cell) {
            if (c != '"')
                cell += c;
            else if (i + 1 < text.size() && text[i + 1] == '"')
                cell += text[++i];
            else
                quoted_cell = false;
            if (c == '\n') ++line;
        } else if (c == '"' && cell.empty()) {
            quoted_cell = true;
        } else if (c == separator) {
            row.push_back(std::move(cell));
            cell.clear();
        } else if (c == '\n' || c == '\r') {
            if (c == '\r' && i + 1 < text.size() && text[i + 1] == '\n') ++i;
            end_row();
            ++line;
        } else {
            cell += c;
        }
    }
    if (quoted_cell)
        throw Error(place + ":" + std::to_string(row_line), "a closing quote",
                    "the end of the file");
    if (!cell.empty() || !row.empty()) end_row();
    return rows;
}

Json value_of(const std::string& cell) {
    if (cell == "true") return true;
    if (cell == "false") return false;
    double number = 0;
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), number);
    if (error == std::errc() && end == cell.data() + cell.size() && std::isfinite(number))
        return json_number(number);
    return cell;
}

}  // namespace

std::vector<std::vector<Given>> read_table(const std::filesystem::path& file, ColumnNames allowed) {
    const auto rows = cells_of(read_text(file, kTable), file.string());
    if (rows.size() < 2)
        throw Error(file.string(), "a row of names and a row for every condition",
                    std::to_string(rows.size()) + (rows.size() == 1 ? " row" : " rows"));
    const std::vector<std::string>& names = rows[0].second;
    std::set<std::string> seen;
    for (const std::string& name : names) {
        if (allowed == ColumnNames::kOfParameters && !is_parameter_name(name))
            throw Error(file.string() + ":1", "names of letters, digits and _",
                        risorius::in_quotes(name));
        if (!seen.insert(name).second)
            throw Error(file.string() + ":1", "every name once",
                        risorius::in_quotes(name) + " again");
    }
    std::vector<std::vector<Given>> out;
    for (std::size_t r = 1; r < rows.size(); ++r) {
        const auto& [line, cells] = rows[r];
        const std::string place = file.string() + ":" + std::to_string(line);
        if (cells.size() != names.size())
            throw Error(place, std::to_string(names.size()) + " cells, as in the first row",
                        std::to_string(cells.size()));
        std::vector<Given>& row = out.emplace_back();
        for (std::size_t c = 0; c < cells.size(); ++c)
            if (!cells[c].empty())
                row.push_back(
                    {names[c], JsonCursor::from_json(value_of(cells[c]), place + ", " + names[c])});
    }
    return out;
}

std::string row_place(const std::vector<Given>& row) {
    const std::string place = row.front().value.place();
    return place.substr(0, place.rfind(":/"));
}

}  // namespace risorius::design
