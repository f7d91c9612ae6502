// SPDX-License-Identifier: MIT
#include "risorius/speech/labels.h"

#include <algorithm>
#include <cmath>

#include "risorius/core/error.h"
#include "risorius/core/known_names.h"
#include "risorius/core/read_file.h"
#include "risorius/speech/detail/labels/label_parser.h"
#include "risorius/speech/detail/table_lines.h"

namespace risorius::speech {

namespace {

constexpr FileKind kLabels{"a file of labels", 100 * kMegabyte};
// Visemes have no closures: p, b and m are closed for this last part of their time.
constexpr double kVisemeClosure = 0.6;

struct Format {
    const char* name;
    LabelFile (*parse)(const LabelText&);
    Gaps gaps;
    const char* symbols;  ///< the usual set; "": found by the labels
};

constexpr Format kFormats[] = {
    {"textgrid", parse_textgrid, Gaps::kErrors, ""},
    {"ctm", parse_ctm, Gaps::kPauses, ""},
    {"lab", parse_lab, Gaps::kPauses, ""},
    {"audacity", parse_audacity, Gaps::kPauses, ""},
    {"pho", parse_pho, Gaps::kErrors, "xsampa"},
    {"seg", parse_seg, Gaps::kErrors, ""},
    {"vtt", parse_subtitles, Gaps::kPauses, ""},
    {"srt", parse_subtitles, Gaps::kPauses, ""},
    {"rhubarb", parse_rhubarb, Gaps::kErrors, "rhubarb"},
    {"azure", parse_viseme_json, Gaps::kErrors, "azure"},
    {"polly", parse_viseme_json, Gaps::kErrors, "polly"},
    {"headtts", parse_viseme_json, Gaps::kPauses, "oculus"},
    {"eaf", parse_eaf, Gaps::kPauses, ""},
};

const Format& format_named(const std::string& name, const std::string& place) {
    return kFormats[index_of_name(place, name, label_formats())];
}

bool is_viseme_format(const std::string& name) {
    return name == "rhubarb" || name == "azure" || name == "polly" || name == "headtts";
}

const LabelTier* tier_named(const LabelFile& file, const std::string& wanted,
                            const std::vector<std::string>& usual, const std::string& name) {
    const auto fits = [&](const LabelTier& tier, const std::string& one) {
        // The Montreal aligner writes "speaker - phones".
        return tier.name == one || tier.name.ends_with(" - " + one);
    };
    for (const std::string& one : wanted.empty() ? usual : std::vector<std::string>{wanted})
        for (const LabelTier& tier : file.tiers)
            if (fits(tier, one)) return &tier;
    if (wanted.empty()) return nullptr;
    std::vector<std::string> names;
    for (const LabelTier& tier : file.tiers) names.push_back(tier.name);
    std::string listed;
    for (const std::string& one : names) listed += " " + in_quotes(one);
    throw Error(name, "a tier" + did_you_mean(wanted, names) + ", one of" + listed,
                in_quotes(wanted));
}

/// The set of symbols that all labels belong to.
std::string set_of(const LabelTier& tier, const PhoneTable& table) {
    // Stress digits and two capitals tell the ARPABET at once; otherwise IPA.
    std::string_view capital;
    for (const Label& label : tier.labels) {
        const std::string text = trimmed(label.text);
        if (text.size() >= 2 && text.size() <= 3 && text[0] >= 'A' && text[0] <= 'Z' &&
            text != "SIL" && text != "SP")
            capital = text;
    }
    const auto& sets = table.sets();
    const bool known = std::find(sets.begin(), sets.end(), "arpabet") != sets.end();
    return !capital.empty() && known ? "arpabet" : "ipa";
}

void add_pause(Utterance& out, std::int64_t start, std::int64_t end) {
    if (end <= start) return;
    if (!out.phones.empty() && out.phones.back().is_pause()) {
        out.phones.back().end = end;
        return;
    }
    Phone pause;
    pause.symbol = kPause;
    pause.start = start;
    pause.end = end;
    out.phones.push_back(std::move(pause));
}

void add_phones(const Label& label, const std::string& set, bool visemes, const PhoneTable& table,
                Utterance& out) {
    const std::vector<SplitPhone> parts = table.split(label.text, set, label.place);
    for (Phone& phone : timed_phones(parts, label.start, label.end)) {
        if (phone.is_pause()) {
            add_pause(out, phone.start, phone.end);
            continue;
        }
        if (visemes && table.phone(phone.symbol, label.place).kind == PhoneClass::kClosure) {
            phone.closure = phone.end - std::llround(kVisemeClosure *
                                                     static_cast<double>(phone.end - phone.start));
            phone.release = phone.end;
        }
        out.phones.push_back(std::move(phone));
    }
}

}  // namespace

const std::vector<std::string>& label_formats() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> out;
        for (const Format& format : kFormats) out.emplace_back(format.name);
        return out;
    }();
    return names;
}

std::string label_format_of(std::string_view text, const std::filesystem::path& file) {
    std::string ending = file.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    const std::string begin = trimmed(text.substr(0, 600));
    const auto has = [&](std::string_view part) { return begin.find(part) != std::string::npos; };
    if (has("ooTextFile")) return "textgrid";
    if (begin.starts_with("WEBVTT")) return "vtt";
    if (ending == ".srt") return "srt";
    if (ending == ".ctm" || ending == ".pho") return ending.substr(1);
    if (ending == ".eaf" || has("ANNOTATION_DOCUMENT")) return "eaf";
    if (has("mouthCue") || has("rhubarb")) return "rhubarb";
    if (begin.starts_with('[')) return "azure";
    if (begin.starts_with('{')) return has("\"type\"") ? "polly" : "headtts";
    if (ending == ".seg") return "seg";
    if (ending == ".lab") return begin.find('#') == 0 || has("\n#") ? "seg" : "lab";
    if (ending == ".tsv") return "rhubarb";
    if (ending == ".txt") return "audacity";
    std::string all;
    for (const std::string& name : label_formats()) all += (all.empty() ? "" : ", ") + name;
    throw Error(file.string(), "a file of labels: " + all, in_quotes(ending));
}

LabelFile parse_labels(const std::string& bytes, const std::string& format, const std::string& name,
                       int rate_hz) {
    const Format& known = format_named(format, name);
    LabelFile out = known.parse({utf8_of(bytes, name), name, rate_hz});
    out.format = known.name;
    std::int64_t end = 0;
    for (LabelTier& tier : out.tiers) {
        check_tier(tier, rate_hz, known.gaps);
        if (!tier.labels.empty()) end = std::max(end, tier.labels.back().end);
    }
    if (out.samples == 0) out.samples = end;
    if (end > out.samples + static_cast<std::int64_t>(kSlack_s * rate_hz))
        throw Error(
            name, "labels that end before the file does, at sample " + std::to_string(out.samples),
            std::to_string(end));
    return out;
}

LabelFile read_labels(const std::filesystem::path& file, const std::string& format, int rate_hz) {
    const std::string bytes = read_file(file, kLabels);
    const std::string chosen =
        format.empty() ? label_format_of(utf8_of(bytes, file.string()), file) : format;
    return parse_labels(bytes, chosen, file.string(), rate_hz);
}

Utterance utterance_of_labels(const LabelFile& labels, const LabelOptions& options,
                              const PhoneTable& table, int rate_hz,
                              std::optional<std::int64_t> samples, const std::string& name) {
    const LabelTier* phones =
        tier_named(labels, options.phones_tier,
                   {"phones", "phone", "Phones", "MAU", "segments", "phonemes", "visemes"}, name);
    const LabelTier* words =
        tier_named(labels, options.words_tier, {"words", "word", "Words", "ORT-MAU", "ORT"}, name);
    if (!phones && labels.tiers.size() == 1 && labels.tiers[0].name != "sentences")
        phones = &labels.tiers[0];
    if (!phones) {
        std::string listed;
        for (const LabelTier& tier : labels.tiers) listed += " " + in_quotes(tier.name);
        throw Error(name, "a tier of phones", listed.empty() ? "no tier" : "only" + listed);
    }
    const Format& format = format_named(labels.format, name);
    std::string set = options.symbols;
    if (set.empty()) set = format.symbols;
    if (set.empty()) set = set_of(*phones, table);
    Utterance out;
    out.rate_hz = rate_hz;
    out.samples = samples.value_or(labels.samples);
    out.language = options.language;
    out.source.program = labels.format;
    const bool visemes = is_viseme_format(labels.format);
    std::int64_t at = 0;
    for (const Label& label : phones->labels) {
        if (label.end > out.samples + static_cast<std::int64_t>(kSlack_s * rate_hz))
            throw Error(label.place,
                        "a label within the sound, which ends at " +
                            format_number(out.seconds(out.samples)) + " s",
                        "one that ends at " + format_number(out.seconds(label.end)) + " s");
        add_pause(out, at, label.start);
        Label cut = label;
        cut.end = std::min(cut.end, out.samples);
        if (cut.end <= cut.start) continue;
        add_phones(cut, set, visemes, table, out);
        at = cut.end;
    }
    add_pause(out, at, out.samples);
    const auto spans = [&](const LabelTier& tier, std::vector<Span>& to) {
        for (const Label& label : tier.labels)
            if (!trimmed(label.text).empty() && trimmed(label.text) != "<eps>")
                to.push_back({trimmed(label.text), label.start, std::min(label.end, out.samples)});
    };
    if (words) spans(*words, out.words);
    if (const LabelTier* sentences = tier_named(labels, "", {"sentences"}, name))
        spans(*sentences, out.sentences);
    check_utterance(out, table, name);
    return out;
}

}  // namespace risorius::speech
