// SPDX-License-Identifier: MIT
// Reads subtitles, WebVTT and SRT: sentences or words with their times. Writes words as WebVTT.
#include <cmath>

#include "risorius/core/error.h"
#include "risorius/core/text_lines.h"
#include "risorius/speech/detail/labels/label_parser.h"
#include "risorius/speech/detail/table_lines.h"

namespace risorius::speech {

namespace {

constexpr std::string_view kArrow = "-->";

/// "01:02:03.456", "02:03.456" or, in SRT, "01:02:03,456"
double seconds_of(const std::string& text, const std::string& place) {
    constexpr const char* kExpected = "a time such as 00:01:02.345";
    std::string plain = text;
    for (char& c : plain)
        if (c == ',') c = '.';
    const std::vector<std::string> parts = cells_of(plain, ':');
    if (parts.size() < 2 || parts.size() > 3) throw Error(place, kExpected, in_quotes(text));
    double seconds = 0;
    for (const std::string& part : parts)
        seconds = 60 * seconds + number_in(part, place, kExpected);
    return seconds;
}

std::string without_tags(std::string_view text) {
    std::string out;
    bool inside = false;
    for (const char c : text) {
        if (c == '<') inside = true;
        if (!inside) out += c;
        if (c == '>') inside = false;
    }
    return trimmed(out);
}

std::string clock(double seconds) {
    const auto ms = static_cast<long long>(std::llround(seconds * 1000));
    char text[48];
    std::snprintf(text, sizeof text, "%02lld:%02lld:%02lld.%03lld", ms / 3600000, ms / 60000 % 60,
                  ms / 1000 % 60, ms % 1000);
    return text;
}

}  // namespace

LabelFile parse_subtitles(const LabelText& file) {
    LabelTier tier{"sentences", {}};
    bool in_cue = false;
    for (TextLines lines(file.text); lines.next();) {
        const std::string place = file.place(lines.number());
        const std::size_t arrow = lines.line().find(kArrow);
        if (arrow != std::string_view::npos) {
            const std::vector<std::string> after =
                words_of(lines.line().substr(arrow + kArrow.size()));
            if (after.empty()) throw Error(place, "a time after \"-->\"", "none");
            tier.labels.push_back(
                {file.sample(seconds_of(trimmed(lines.line().substr(0, arrow)), place), place),
                 file.sample(seconds_of(after[0], place), place), "", place});
            in_cue = true;
        } else if (trimmed(lines.line()).empty()) {
            in_cue = false;
        } else if (in_cue) {
            std::string& text = tier.labels.back().text;
            text += (text.empty() ? "" : " ") + without_tags(lines.line());
        }
    }
    return {file.text.starts_with("WEBVTT") ? "vtt" : "srt", {std::move(tier)}, 0};
}

std::string webvtt_text(const Utterance& utterance) {
    std::string out = "WEBVTT\n";
    for (const Span& word : utterance.words.empty() ? utterance.sentences : utterance.words)
        out += "\n" + clock(utterance.seconds(word.start)) + " --> " +
               clock(utterance.seconds(word.end)) + "\n" + word.text + "\n";
    return out;
}

std::string ctm_text(const Utterance& utterance) {
    std::string name = utterance.sound.stem().string();
    for (char& c : name)
        if (c == ' ' || c == '\t') c = '_';
    std::string out;
    for (const Phone& phone : utterance.phones)
        if (!phone.is_pause())
            out += (name.empty() ? "speech" : name) + " 1 " +
                   format_number(utterance.seconds(phone.start)) + " " +
                   format_number(utterance.seconds(phone.end - phone.start)) + " " + phone.text() +
                   "\n";
    return out;
}

}  // namespace risorius::speech
