// SPDX-License-Identifier: MIT
// Tables of OpenSim over time (.sto, .mot): a header of lines "key=value" up to "endheader", the names of the columns, and rows. Source:
// OpenSim 4 documentation, "Storage (.sto) Files" and "Motion (.mot) Files".
#include <charconv>
#include <cmath>

#include "risorius/core/error.h"
#include "risorius/core/text_lines.h"
#include "risorius/motion/detail/motion_readers.h"

namespace risorius::motion::detail {

namespace {

std::vector<std::string_view> words_of(std::string_view line) {
    std::vector<std::string_view> out;
    for (std::size_t at = 0; (at = line.find_first_not_of(" \t", at)) != std::string_view::npos;) {
        const std::size_t end = std::min(line.find_first_of(" \t", at), line.size());
        out.push_back(line.substr(at, end - at));
        at = end;
    }
    return out;
}

/// The name of a muscle in a column: without the path of a state, "/forceset/NAME/activation", and without the ending of an older one,
/// "NAME.activation". Empty for a column of another state.
std::string_view muscle_of(std::string_view column) {
    constexpr std::string_view kSet = "/forceset/", kState = "/activation", kOlder = ".activation";
    if (column.starts_with('/')) {
        if (!column.starts_with(kSet)) return {};
        column.remove_prefix(kSet.size());
        if (column.ends_with(kState)) column.remove_suffix(kState.size());
        return column.find('/') == std::string_view::npos ? column : std::string_view();
    }
    if (column.ends_with(kOlder)) column.remove_suffix(kOlder.size());
    if (column.ends_with(".l") || column.ends_with(".r")) return column;
    return column.find_first_of("./|") == std::string_view::npos ? column : std::string_view();
}

/// The channel of a muscle: "zygomaticus_major_l" is "zygomaticus_major.l".
std::string channel_of(std::string_view muscle) {
    std::string out(muscle);
    if (out.ends_with("_l") || out.ends_with("_r")) out[out.size() - 2] = '.';
    return out;
}

/// The muscle of a bundle: "frontalis_2.l" is a part of "frontalis.l". Empty for a name without a number.
std::string whole_of(const std::string& channel) {
    const std::size_t end =
        channel.ends_with(".l") || channel.ends_with(".r") ? channel.size() - 2 : channel.size();
    const std::size_t bar = channel.find_last_not_of("0123456789", end - 1);
    if (bar == std::string::npos || bar + 1 == end || channel[bar] != '_') return {};
    return channel.substr(0, bar) + channel.substr(end);
}

double number_in(std::string_view word, const std::string& place) {
    double value = 0;
    const auto [end, problem] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (problem != std::errc() || end != word.data() + word.size() || !std::isfinite(value))
        throw Error(place, "a number", in_quotes(std::string(word)));
    return value;
}

}  // namespace

RecordedMotion read_storage(const std::filesystem::path& file, double fps) {
    const std::string text = read_text(file, kMotionFile), name = file.string();
    MotionBuilder builder;
    std::vector<std::string> columns;
    bool header = true;
    for (TextLines lines(text); lines.next();) {
        const std::string place = name + ": line " + std::to_string(lines.number());
        const std::vector<std::string_view> words = words_of(lines.line());
        if (header) {
            header = words.empty() || lower_case(words.front()) != "endheader";
            continue;
        }
        if (words.empty()) continue;
        if (columns.empty()) {
            if (lower_case(words.front()) != "time")
                throw Error(place, "time as the first column",
                            in_quotes(std::string(words.front())));
            for (const std::string_view word : words) columns.emplace_back(word);
            continue;
        }
        if (words.size() != columns.size())
            throw Error(place, std::to_string(columns.size()) + " numbers, as the columns",
                        std::to_string(words.size()));
        builder.begin(number_in(words.front(), place), true);
        for (std::size_t c = 1; c < words.size(); ++c) {
            const std::string_view muscle = muscle_of(columns[c]);
            if (muscle.empty()) {
                builder.unmapped(columns[c]);
                continue;
            }
            const std::string channel = channel_of(muscle), whole = whole_of(channel);
            builder.set(whole.empty() ? channel : whole,
                        number_in(words[c], place + ", column " + columns[c]));
        }
    }
    if (header) throw Error(name, "a line endheader", "none");
    builder.motion().keyed = true;  // steps of OpenSim have any length
    return builder.finish(name, "storage", fps);
}

}  // namespace risorius::motion::detail
