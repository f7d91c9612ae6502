// SPDX-License-Identifier: MIT
// Reads visemes and words of speech services, Azure, Polly and HeadTTS (TalkingHead), and annotations of ELAN.
#include <algorithm>
#include <map>

#include "risorius/core/error.h"
#include "risorius/core/json_text.h"
#include "risorius/core/text_lines.h"
#include "risorius/speech/detail/labels/label_parser.h"
#include "risorius/speech/detail/labels/xml_tags.h"
#include "risorius/speech/detail/table_lines.h"

namespace risorius::speech {

namespace {

constexpr double kMark_s = 1e-3, kTick_s = 1e-7;
constexpr int kLastAzureViseme = 21;
// How long the last viseme is shown where the file does not say
constexpr double kLastViseme_s = 0.1;

std::optional<JsonCursor> find_any(const JsonCursor& json,
                                   const std::vector<std::string_view>& keys) {
    for (const std::string_view key : keys)
        if (const auto found = json.find(key)) return found;
    return std::nullopt;
}

/// Each label lasts until the next one begins.
void end_at_next(LabelTier& tier, int rate_hz) {
    for (std::size_t i = 0; i + 1 < tier.labels.size(); ++i)
        tier.labels[i].end = std::max(tier.labels[i].start, tier.labels[i + 1].start);
    if (!tier.labels.empty())
        tier.labels.back().end =
            tier.labels.back().start + static_cast<std::int64_t>(kLastViseme_s * rate_hz);
}

LabelFile azure(const LabelText& file, const std::vector<JsonCursor>& events) {
    LabelTier tier{"visemes", {}};
    for (const JsonCursor& event : events) {
        const auto offset = find_any(event, {"audioOffset", "audio_offset", "AudioOffset"});
        const auto id = find_any(event, {"visemeId", "viseme_id", "VisemeId"});
        if (!offset || !id) event.fail("\"audioOffset\" and \"visemeId\"");
        const std::int64_t start = file.sample(offset->number() * kTick_s, offset->place());
        tier.labels.push_back(
            {start, start, std::to_string(id->integer(0, kLastAzureViseme)), event.place()});
    }
    end_at_next(tier, file.rate_hz);
    return {"azure", {std::move(tier)}, 0};
}

LabelFile headtts(const LabelText& file, const JsonCursor& json) {
    LabelFile out{"headtts", {}, 0};
    for (const auto& [name, list, starts, lengths] :
         {std::array{"visemes", "visemes", "vtimes", "vdurations"},
          std::array{"words", "words", "wtimes", "wdurations"}}) {
        if (!json.has(list)) continue;
        LabelTier tier{name, {}};
        const std::vector<JsonCursor> texts = json.at(list).items(), from = json.at(starts).items(),
                                      time = json.at(lengths).items();
        if (from.size() != texts.size() || time.size() != texts.size())
            json.at(list).fail(
                "as many entries as " + in_quotes(starts) + " and " + in_quotes(lengths) + " have",
                std::to_string(texts.size()));
        for (std::size_t i = 0; i < texts.size(); ++i) {
            const double start_ms = from[i].number();
            tier.labels.push_back(
                {file.sample(start_ms * kMark_s, from[i].place()),
                 file.sample((start_ms + time[i].number()) * kMark_s, time[i].place()),
                 trimmed(texts[i].string()), texts[i].place()});
        }
        out.tiers.push_back(std::move(tier));
    }
    return out;
}

LabelFile polly(const LabelText& file) {
    LabelTier visemes{"visemes", {}}, words{"words", {}}, sentences{"sentences", {}};
    for (TextLines lines(file.text); lines.next();) {
        if (trimmed(lines.line()).empty()) continue;
        const std::string place = file.place(lines.number());
        const JsonCursor mark = parse_json_text(std::string(lines.line()), place);
        const std::string type = mark.at("type").string();
        LabelTier* tier = type == "viseme"     ? &visemes
                          : type == "word"     ? &words
                          : type == "sentence" ? &sentences
                                               : nullptr;
        if (!tier) continue;  // "ssml"
        const std::int64_t start = file.sample(mark.at("time").number() * kMark_s, place);
        tier->labels.push_back({start, start, mark.at("value").string(), place});
    }
    LabelFile out{"polly", {}, 0};
    for (LabelTier* tier : {&visemes, &words, &sentences}) {
        end_at_next(*tier, file.rate_hz);
        if (!tier->labels.empty()) out.tiers.push_back(std::move(*tier));
    }
    return out;
}

}  // namespace

LabelFile parse_viseme_json(const LabelText& file) {
    const std::string begin = trimmed(file.text.substr(0, 400));
    if (begin.starts_with('[')) return azure(file, parse_json_text(file.text, file.name).items());
    if (begin.find("\"type\"") != std::string::npos) return polly(file);
    return headtts(file, parse_json_text(file.text, file.name));
}

LabelFile parse_eaf(const LabelText& file) {
    LabelFile out{"eaf", {}, 0};
    std::map<std::string, double> slots_ms;
    for (XmlTags tags(file.text, file.name); tags.next();) {
        const std::string place = tags.place();
        if (tags.tag() == "TIME_SLOT") {
            if (const std::string value = tags.attribute_or("TIME_VALUE", ""); !value.empty())
                slots_ms[tags.attribute("TIME_SLOT_ID")] =
                    number_in(value, place, "a time in milliseconds");
        } else if (tags.tag() == "TIER") {
            out.tiers.push_back({tags.attribute("TIER_ID"), {}});
        } else if (tags.tag() == "ALIGNABLE_ANNOTATION") {
            if (out.tiers.empty()) throw Error(place, "an annotation within a tier", "none");
            const auto time = [&](const char* key) {
                const auto found = slots_ms.find(tags.attribute(key));
                if (found == slots_ms.end())
                    throw Error(place, "a time slot with a value",
                                in_quotes(shortened_text(tags.attribute(key), 60)));
                return file.sample(found->second * kMark_s, place);
            };
            const std::int64_t start = time("TIME_SLOT_REF1");
            out.tiers.back().labels.push_back({start, time("TIME_SLOT_REF2"), "", place});
        } else if (tags.tag() == "/ANNOTATION_VALUE" && !out.tiers.empty() &&
                   !out.tiers.back().labels.empty()) {
            out.tiers.back().labels.back().text = trimmed(tags.before());
        }
    }
    for (LabelTier& tier : out.tiers)
        std::stable_sort(tier.labels.begin(), tier.labels.end(),
                         [](const Label& a, const Label& b) { return a.start < b.start; });
    return out;
}

}  // namespace risorius::speech
