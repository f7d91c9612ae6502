// SPDX-License-Identifier: MIT
#include "risorius/inverse/code_agreement.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "risorius/core/error.h"
#include "risorius/core/json_object.h"
#include "risorius/core/text_lines.h"

namespace risorius::inverse {

namespace {

constexpr FileKind kSheet{"a table of codes", 10 * kMegabyte};

std::string trimmed(std::string_view text) {
    const auto begin = text.find_first_not_of(" \""), end = text.find_last_not_of(" \"");
    return begin == std::string_view::npos ? "" : std::string(text.substr(begin, end - begin + 1));
}

std::vector<std::string> cells_of(std::string_view line) {
    std::vector<std::string> out;
    for (std::size_t begin = 0;;) {
        const std::size_t end = line.find('\t', begin);
        out.push_back(trimmed(line.substr(begin, end - begin)));
        if (end == std::string_view::npos) return out;
        begin = end + 1;
    }
}

using Codes = std::map<std::string, std::vector<CodedUnit>>;

// The codes of each clip.
Codes read_sheet(const std::filesystem::path& file) {
    const std::string text = read_text(file, kSheet), place = file.string();
    Codes out;
    for (TextLines lines(text); lines.next();) {
        const std::string where = place + ":" + std::to_string(lines.number());
        const std::vector<std::string> cells = cells_of(lines.line());
        if (lines.number() == 1) {
            if (cells.size() < 2 || cells[0] != "clip" || cells[1] != "codes")
                throw Error(where, "the columns clip and codes, separated by tabs",
                            "\"" + std::string(lines.line().substr(0, 60)) + "\"");
            continue;
        }
        if (cells.size() == 1 && cells[0].empty()) continue;
        if (cells.size() < 2) throw Error(where, "a clip and its codes", "one column");
        if (!out.emplace(cells[0], read_codes(cells[1], where)).second)
            throw Error(where, "each clip once", "\"" + cells[0] + "\" again");
    }
    if (out.empty()) throw Error(place, "a row for each clip", "none");
    return out;
}

const CodedUnit* find(const std::vector<CodedUnit>& codes, int unit) {
    const auto found = std::find_if(codes.begin(), codes.end(),
                                    [&](const CodedUnit& one) { return one.number == unit; });
    return found == codes.end() ? nullptr : &*found;
}

// Cohen 1960, Educational and Psychological Measurement 20, 37-46.
double kappa_of(double both, double shown, double seen, double clips) {
    const double neither = clips - shown - seen + both;
    const double agreed = (both + neither) / clips,
                 chance = (shown * seen + (clips - shown) * (clips - seen)) / (clips * clips);
    if (shown == 0 && seen == 0) return std::numeric_limits<double>::quiet_NaN();
    return chance == 1 ? 1 : (agreed - chance) / (1 - chance);
}

}  // namespace

std::vector<CodedUnit> read_codes(const std::string& text, const std::string& place) {
    std::vector<CodedUnit> out;
    if (text.empty() || text == "0") return out;
    const auto fail = [&](const std::string& part) {
        throw Error(place, "codes such as 1C+2C, R12B or 0", "\"" + part + "\"");
    };
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find('+', begin), text.size());
        const std::string part = trimmed(std::string_view(text).substr(begin, end - begin));
        begin = end + 1;
        CodedUnit unit;
        std::size_t at = 0;
        if (at < part.size() && (part[at] == 'L' || part[at] == 'R'))
            unit.side = part[at++] == 'L' ? Side::kLeft : Side::kRight;
        const std::size_t digits = at;
        for (; at < part.size() && part[at] >= '0' && part[at] <= '9' && at < digits + 2; ++at)
            unit.number = 10 * unit.number + (part[at] - '0');
        if (at == digits || unit.number == 0) fail(part);
        if (at < part.size() && part[at] >= 'A' && part[at] <= 'E')
            unit.level = part[at++] - 'A' + 1;
        if (at != part.size()) fail(part);
        if (find(out, unit.number))
            throw Error(place, "each unit once", std::to_string(unit.number) + " twice");
        out.push_back(unit);
    }
    return out;
}

Agreement code_agreement(const std::filesystem::path& sheet, const std::filesystem::path& key) {
    const Codes shown = read_sheet(key), seen = read_sheet(sheet);
    for (const auto& [clip, codes] : seen)
        if (!shown.count(clip))
            throw Error(sheet.string(), "the clips of " + key.string(), "\"" + clip + "\"");
    std::set<int> numbers;
    for (const auto& [clip, codes] : shown) {
        if (!seen.count(clip))
            throw Error(sheet.string(), "a row for each clip of the key", "none for " + clip);
        for (const Codes* of : {&shown, &seen})
            for (const CodedUnit& one : of->at(clip)) numbers.insert(one.number);
    }
    Agreement out;
    out.clips = static_cast<int>(shown.size());
    int agreed = 0, all = 0;
    for (const int number : numbers) {
        UnitAgreement unit;
        unit.unit = number;
        for (const auto& [clip, codes] : shown) {
            const CodedUnit* a = find(codes, number);
            const CodedUnit* b = find(seen.at(clip), number);
            unit.shown += a != nullptr;
            unit.seen += a && b;
            unit.falsely_seen += !a && b;
            if (a && b && a->level && b->level) {
                ++unit.levels;
                unit.levels_within_1 += std::abs(*a->level - *b->level) <= 1;
            }
        }
        unit.kappa = kappa_of(unit.seen, unit.shown, unit.seen + unit.falsely_seen, out.clips);
        agreed += unit.seen;
        all += unit.shown + unit.seen + unit.falsely_seen;
        out.units.push_back(unit);
    }
    out.index = all > 0 ? 2.0 * agreed / all : 1;
    return out;
}

Json Agreement::json() const {
    Json list = Json::array();
    for (const UnitAgreement& one : units)
        list.push_back(json_object({{"unit", "AU" + std::to_string(one.unit)},
                                    {"shown", one.shown},
                                    {"seen", one.seen},
                                    {"falsely_seen", one.falsely_seen},
                                    {"kappa", std::isnan(one.kappa) ? Json() : Json(one.kappa)},
                                    {"levels", one.levels},
                                    {"levels_within_1", one.levels_within_1}}));
    return json_object({{"format", "risorius-code-agreement"},
                        {"version", 1},
                        {"clips", clips},
                        {"index", index},
                        {"units", list}});
}

}  // namespace risorius::inverse
