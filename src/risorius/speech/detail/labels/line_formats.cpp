// SPDX-License-Identifier: MIT
// Reads labels with a line each: CTM, HTK, Audacity, MBROLA and Festival.
#include <cmath>

#include "risorius/core/error.h"
#include "risorius/core/text_lines.h"
#include "risorius/speech/detail/labels/label_parser.h"
#include "risorius/speech/detail/table_lines.h"

namespace risorius::speech {

namespace {

constexpr double kHtkUnit_s = 1e-7, kMillisecond_s = 1e-3;

Error wrong_line(const std::string& place, const std::string& expected, std::string_view line) {
    return {place, expected, in_quotes(shortened_text(line, 80))};
}

/// The text of a line from its nth word on.
std::string rest_from(std::string_view line, std::size_t n) {
    for (std::size_t i = 0; i < n; ++i) {
        const std::size_t begin = line.find_first_not_of(" \t");
        const std::size_t end = line.find_first_of(" \t", begin);
        if (end == std::string_view::npos) return "";
        line.remove_prefix(end);
    }
    return trimmed(line);
}

}  // namespace

LabelFile parse_ctm(const LabelText& file) {
    LabelTier tier{"", {}};
    std::string recording, channel;
    for (TextLines lines(file.text); lines.next();) {
        const std::vector<std::string> words = words_of(lines.line());
        if (words.empty() || words[0].starts_with(";;")) continue;
        const std::string place = file.place(lines.number());
        if (words.size() < 5)
            throw wrong_line(place, "a recording, a channel, a start, a duration and a label",
                             lines.line());
        if (recording.empty()) {
            recording = words[0];
            channel = words[1];
        }
        if (words[0] != recording || words[1] != channel)
            throw wrong_line(place,
                             "labels of one channel of one recording, " + recording + " " + channel,
                             words[0] + " " + words[1]);
        const double start_s = number_in(words[2], place, "a start in seconds");
        const double duration_s = number_in(words[3], place, "a duration in seconds");
        if (duration_s < 0) throw wrong_line(place, "a duration of 0 or more", words[3]);
        tier.labels.push_back({file.sample(start_s, place),
                               file.sample(start_s + duration_s, place), words[4], place});
    }
    return {"ctm", {std::move(tier)}, 0};
}

LabelFile parse_lab(const LabelText& file) {
    // HTK writes units of 100 ns. Other programs write seconds, with a decimal point.
    LabelTier phones{"phones", {}}, words{"words", {}};
    bool in_seconds = false;
    for (TextLines lines(file.text); lines.next();) {
        const std::vector<std::string> cells = words_of(lines.line());
        in_seconds = in_seconds || (!cells.empty() && cells[0].find('.') != std::string::npos) ||
                     (cells.size() > 1 && cells[1].find('.') != std::string::npos);
    }
    const double unit_s = in_seconds ? 1 : kHtkUnit_s;
    for (TextLines lines(file.text); lines.next();) {
        const std::vector<std::string> cells = words_of(lines.line());
        if (cells.empty() || cells[0] == "#!MLF!#" || cells[0].starts_with('"') || cells[0] == ".")
            continue;
        const std::string place = file.place(lines.number());
        if (cells.size() < 3) throw wrong_line(place, "a start, an end and a label", lines.line());
        Label label{file.sample(cells[0], unit_s, place), file.sample(cells[1], unit_s, place),
                    cells[2], place};
        // HVite adds a score, and the word at its first phone.
        if (cells.size() > 4)
            words.labels.push_back({label.start, label.end, cells[4], place});
        else if (!words.labels.empty() && words.labels.back().end <= label.start)
            words.labels.back().end = label.end;
        phones.labels.push_back(std::move(label));
    }
    LabelFile out{"lab", {std::move(phones)}, 0};
    if (!words.labels.empty()) out.tiers.push_back(std::move(words));
    return out;
}

LabelFile parse_audacity(const LabelText& file) {
    LabelTier tier{"", {}};
    for (TextLines lines(file.text); lines.next();) {
        // A line with a backslash is the range of frequencies of the label before.
        if (trimmed(lines.line()).empty() || lines.line().starts_with('\\')) continue;
        const std::string place = file.place(lines.number());
        const std::vector<std::string> cells = cells_of(lines.line(), '\t');
        if (cells.size() < 2 || cells.size() > 3)
            throw wrong_line(place, "a start, an end and a label with tabs between", lines.line());
        // With a decimal comma in some languages
        const auto time = [&](std::string cell) {
            for (char& c : cell)
                if (c == ',') c = '.';
            return file.sample(trimmed(cell), 1, place);
        };
        tier.labels.push_back(
            {time(cells[0]), time(cells[1]), cells.size() > 2 ? trimmed(cells[2]) : "", place});
    }
    return {"audacity", {std::move(tier)}, 0};
}

LabelFile parse_pho(const LabelText& file) {
    LabelTier tier{"phones", {}};
    double time_ms = 0;
    for (TextLines lines(file.text); lines.next();) {
        const std::string line(lines.line().substr(0, lines.line().find(';')));
        const std::vector<std::string> words = words_of(line);
        if (words.empty()) continue;
        const std::string place = file.place(lines.number());
        if (words.size() < 2)
            throw wrong_line(place, "a symbol and a duration in milliseconds", lines.line());
        const double duration_ms = number_in(words[1], place, "a duration in milliseconds");
        if (duration_ms < 0) throw wrong_line(place, "a duration of 0 or more", words[1]);
        // Times are sums of what the file says, rounded once.
        const std::int64_t start = file.sample(time_ms * kMillisecond_s, place);
        time_ms += duration_ms;
        tier.labels.push_back(
            {start, file.sample(time_ms * kMillisecond_s, place), words[0], place});
    }
    return {"pho", {std::move(tier)}, 0};
}

LabelFile parse_seg(const LabelText& file) {
    LabelTier tier{"phones", {}};
    bool in_header = file.text.find("\n#") != std::string::npos || file.text.starts_with("#");
    std::int64_t before = 0;
    for (TextLines lines(file.text); lines.next();) {
        const std::vector<std::string> words = words_of(lines.line());
        if (in_header) {
            in_header = words.empty() || words[0] != "#";
            continue;
        }
        if (words.empty()) continue;
        const std::string place = file.place(lines.number());
        if (words.size() < 3)
            throw wrong_line(place, "an end in seconds, a number and a label", lines.line());
        const std::int64_t end = file.sample(words[0], 1, place);
        tier.labels.push_back({before, end, rest_from(lines.line(), 2), place});
        before = end;
    }
    return {"seg", {std::move(tier)}, 0};
}

std::string htk_text(const Utterance& utterance) {
    std::string out;
    const auto time = [&](std::int64_t sample) {
        return std::to_string(std::llround(utterance.seconds(sample) * 1e7));
    };
    for (const Phone& phone : utterance.phones)
        out += time(phone.start) + " " + time(phone.end) + " " +
               (phone.is_pause() ? "sil" : phone.text()) + "\n";
    return out;
}

}  // namespace risorius::speech
