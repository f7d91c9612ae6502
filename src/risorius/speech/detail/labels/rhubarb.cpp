// SPDX-License-Identifier: MIT
// Reads and writes the mouth shapes of Rhubarb Lip Sync: TSV, XML and JSON.
#include "risorius/core/error.h"
#include "risorius/core/json_text.h"
#include "risorius/core/text_lines.h"
#include "risorius/speech/detail/labels/label_parser.h"
#include "risorius/speech/detail/labels/xml_tags.h"
#include "risorius/speech/detail/table_lines.h"

namespace risorius::speech {

namespace {

LabelFile rhubarb_tsv(const LabelText& file) {
    LabelTier tier{"visemes", {}};
    for (TextLines lines(file.text); lines.next();) {
        if (trimmed(lines.line()).empty()) continue;
        const std::string place = file.place(lines.number());
        const std::vector<std::string> words = words_of(lines.line());
        if (words.size() != 2)
            throw Error(place, "a time in seconds and a mouth shape",
                        in_quotes(shortened_text(lines.line(), 80)));
        const std::int64_t start = file.sample(words[0], 1, place);
        if (!tier.labels.empty()) tier.labels.back().end = start;
        tier.labels.push_back({start, start, words[1], place});
    }
    // The last line only says when the shape before ends.
    const std::int64_t end = tier.labels.empty() ? 0 : tier.labels.back().end;
    return {"rhubarb", {std::move(tier)}, end};
}

LabelFile rhubarb_xml(const LabelText& file) {
    LabelTier tier{"visemes", {}};
    bool cue = false;
    for (XmlTags tags(file.text, file.name); tags.next();) {
        if (cue && tags.tag() == "/mouthCue") tier.labels.back().text = trimmed(tags.before());
        cue = tags.tag() == "mouthCue";
        if (!cue) continue;
        const std::string place = tags.place();
        tier.labels.push_back({file.sample(tags.attribute("start"), 1, place),
                               file.sample(tags.attribute("end"), 1, place), "", place});
    }
    return {"rhubarb", {std::move(tier)}, 0};
}

LabelFile rhubarb_json(const LabelText& file) {
    LabelTier tier{"visemes", {}};
    for (const JsonCursor& cue : parse_json_text(file.text, file.name).at("mouthCues").items())
        tier.labels.push_back({file.sample(cue.at("start").number(), cue.at("start").place()),
                               file.sample(cue.at("end").number(), cue.at("end").place()),
                               cue.at("value").string(), cue.place()});
    return {"rhubarb", {std::move(tier)}, 0};
}

/// The shape that Rhubarb's own rules give a viseme, see its animationRules.cpp in words: A closed, B teeth together, C open, D wide
/// open, E slightly rounded, F puckered, G teeth on the lip, H tongue up, X rest.
char shape_of(const PhoneEntry& phone) {
    if (phone.symbol == kPause) return 'X';
    switch (phone.kind) {
        case PhoneClass::kClosure:
            return 'A';
        case PhoneClass::kLabiodental:
        case PhoneClass::kLabiodentalSoft:
            return 'G';
        case PhoneClass::kRoundConsonant:
        case PhoneClass::kSibilantRound:
            return 'F';
        case PhoneClass::kVowelRound:
            return value_of(phone.target, Parameter::kGap) < 6 ? 'F' : 'E';
        default:
            break;
    }
    if (phone.viseme == "LL") return 'H';
    const double gap = value_of(phone.target, Parameter::kGap);
    if (!is_vowel(phone.kind)) return 'B';
    return gap > 11 ? 'D' : gap > 7 ? 'C' : 'B';
}

}  // namespace

LabelFile parse_rhubarb(const LabelText& file) {
    const std::string begin = trimmed(file.text.substr(0, 200));
    if (begin.starts_with('<')) return rhubarb_xml(file);
    if (begin.starts_with('{')) return rhubarb_json(file);
    return rhubarb_tsv(file);
}

std::string rhubarb_text(const Utterance& utterance, const PhoneTable& table) {
    std::string out;
    char before = 0;
    const auto add = [&](std::int64_t sample, char shape) {
        out += format_number(utterance.seconds(sample)) + "\t" + shape + "\n";
        before = shape;
    };
    if (utterance.phones.empty() || utterance.phones.front().start > 0) add(0, 'X');
    for (const Phone& phone : utterance.phones)
        if (const char shape = shape_of(table.phone(phone.symbol, "phone")); shape != before)
            add(phone.start, shape);
    add(utterance.samples, 'X');
    return out;
}

}  // namespace risorius::speech
