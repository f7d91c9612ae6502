// SPDX-License-Identifier: MIT
#include "risorius/speech/utterance.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "risorius/core/existing_file.h"
#include "risorius/core/json_object.h"
#include "risorius/core/json_text.h"

namespace risorius::speech {

namespace {

constexpr int kMaxInt = static_cast<int>(kMaxSamples);

std::int64_t sample_of(const JsonCursor& json) { return json.integer(0, kMaxInt); }

std::optional<std::int64_t> moment_of(const JsonCursor& json, std::string_view key) {
    const auto value = json.find(key);
    // The closure before the first sound of an utterance may begin before the recording.
    return value ? std::optional<std::int64_t>(value->integer(-kMaxInt, kMaxInt)) : std::nullopt;
}

std::vector<Span> spans_of(const JsonCursor& json, std::string_view key) {
    std::vector<Span> out;
    if (const auto list = json.find(key))
        for (const JsonCursor& item : list->items()) {
            item.allow_keys({"text", "start", "end"});
            out.push_back(
                {item.at("text").string(), sample_of(item.at("start")), sample_of(item.at("end"))});
            if (out.back().end < out.back().start)
                item.at("end").fail("a sample from " + std::to_string(out.back().start) + " on");
        }
    return out;
}

Phone phone_of(const JsonCursor& item) {
    item.allow_keys(
        {"symbol", "length_mark", "stress", "start", "end", "closure", "release", "voice_onset"});
    Phone phone;
    phone.symbol = item.at("symbol").string();
    if (const auto v = item.find("length_mark")) phone.length_mark = v->integer(0, 2);
    if (const auto v = item.find("stress")) phone.stress = v->integer(0, 2);
    phone.start = sample_of(item.at("start"));
    phone.end = sample_of(item.at("end"));
    phone.closure = moment_of(item, "closure");
    phone.release = moment_of(item, "release");
    phone.voice_onset = moment_of(item, "voice_onset");
    return phone;
}

Json spans_json(const std::vector<Span>& spans) {
    Json out = Json::array();
    for (const Span& span : spans)
        out.push_back(json_object({{"text", span.text}, {"start", span.start}, {"end", span.end}}));
    return out;
}

}  // namespace

std::string Phone::text() const {
    return symbol + (length_mark == 2 ? "ː" : length_mark == 1 ? "ˑ" : "");
}

int Utterance::word_at(std::int64_t sample) const {
    for (std::size_t i = 0; i < words.size(); ++i)
        if (sample >= words[i].start && sample < words[i].end) return static_cast<int>(i);
    return -1;
}

void check_utterance(const Utterance& utterance, const PhoneTable& table,
                     const std::string& place) {
    if (utterance.phones.empty()) throw Error(place + ":/phones", "at least one phone", "none");
    if (utterance.phones.size() > kMostPhones)
        throw Error(place + ":/phones", "at most " + std::to_string(kMostPhones) + " phones",
                    std::to_string(utterance.phones.size()));
    const double minutes = utterance.seconds(utterance.samples) / 60;
    if (minutes > kMostMinutes)
        throw Error(place + ":/samples",
                    "at most " + format_number(kMostMinutes) + " minutes of sound",
                    format_number(minutes));
    std::int64_t before = utterance.phones.front().start;
    for (std::size_t i = 0; i < utterance.phones.size(); ++i) {
        const Phone& phone = utterance.phones[i];
        const std::string at = place + ":/phones/" + std::to_string(i);
        table.phone(phone.symbol, at + "/symbol");
        if (phone.start != before)
            throw Error(at + "/start",
                        std::to_string(before) + ", where the phone before ends (a pause is \"_\")",
                        std::to_string(phone.start));
        if (phone.end <= phone.start)
            throw Error(at + "/end", "a sample after " + std::to_string(phone.start),
                        std::to_string(phone.end));
        if (const double long_s = utterance.seconds(phone.end - phone.start);
            !phone.is_pause() && long_s > kLongestPhone_s)
            throw Error(at + "/end", "a phone of at most " + format_number(kLongestPhone_s) + " s",
                        format_number(long_s) + " s");
        if (phone.end > utterance.samples)
            throw Error(at + "/end",
                        "a sample of the sound, which has " + std::to_string(utterance.samples),
                        std::to_string(phone.end));
        if (phone.closure && phone.release && *phone.release <= *phone.closure)
            throw Error(at + "/release", "a sample after " + std::to_string(*phone.closure),
                        std::to_string(*phone.release));
        before = phone.end;
    }
    for (const auto& [spans, key] :
         {std::pair{&utterance.words, "words"}, std::pair{&utterance.sentences, "sentences"}}) {
        std::int64_t last = 0;
        for (std::size_t i = 0; i < spans->size(); ++i) {
            const Span& span = (*spans)[i];
            if (span.start < last || span.end < span.start || span.end > utterance.samples)
                throw Error(
                    place + ":/" + key + "/" + std::to_string(i),
                    "an interval between " + std::to_string(last) + " and " +
                        std::to_string(utterance.samples),
                    "[" + std::to_string(span.start) + ", " + std::to_string(span.end) + "]");
            last = span.end;
        }
    }
}

Utterance read_utterance(const JsonCursor& json, const PhoneTable& table) {
    json.at("format").one_of({"risorius-utterance"});
    const JsonCursor version = json.at("version");
    if (version.json() != 1) version.fail("1, the version of the format this program reads");
    json.allow_keys({"format", "version", "rate_hz", "samples", "language", "sound", "phones",
                     "words", "sentences", "source"});
    Utterance out;
    out.rate_hz = json.at("rate_hz").integer(1000, 768000);
    out.samples = sample_of(json.at("samples"));
    if (const auto v = json.find("language")) out.language = v->string();
    if (const auto v = json.find("sound")) out.sound = existing_file(*v);
    for (const JsonCursor& item : json.at("phones").items()) out.phones.push_back(phone_of(item));
    out.words = spans_of(json, "words");
    out.sentences = spans_of(json, "sentences");
    if (const auto source = json.find("source")) {
        source->allow_keys({"program", "version", "sha256"});
        out.source.program = source->at("program").string();
        if (const auto v = source->find("version")) out.source.version = v->string();
        if (const auto v = source->find("sha256")) out.source.sha256 = v->string();
    }
    check_utterance(out, table, json.file().string());
    return out;
}

Utterance read_utterance(const std::filesystem::path& file, const PhoneTable& table) {
    return read_utterance(JsonCursor::read_file(file), table);
}

std::string utterance_text(const Utterance& utterance) {
    Json json = json_object({{"format", "risorius-utterance"}, {"version", 1}});
    json["rate_hz"] = utterance.rate_hz;
    json["samples"] = utterance.samples;
    if (!utterance.language.empty()) json["language"] = utterance.language;
    if (!utterance.sound.empty()) json["sound"] = utterance.sound.string();
    // One phone a line: the file is read by people, too.
    json["phones"] = Json::array();
    for (const Phone& phone : utterance.phones) {
        Json one = json_object({{"symbol", phone.symbol}});
        if (phone.length_mark) one["length_mark"] = phone.length_mark;
        if (phone.stress) one["stress"] = phone.stress;
        one["start"] = phone.start;
        one["end"] = phone.end;
        if (phone.closure) one["closure"] = *phone.closure;
        if (phone.release) one["release"] = *phone.release;
        if (phone.voice_onset) one["voice_onset"] = *phone.voice_onset;
        json["phones"].push_back(std::move(one));
    }
    if (!utterance.words.empty()) json["words"] = spans_json(utterance.words);
    if (!utterance.sentences.empty()) json["sentences"] = spans_json(utterance.sentences);
    if (!utterance.source.program.empty()) {
        Json& source = json["source"];
        source["program"] = utterance.source.program;
        if (!utterance.source.version.empty()) source["version"] = utterance.source.version;
        if (!utterance.source.sha256.empty()) source["sha256"] = utterance.source.sha256;
    }
    std::string out = "{\n";
    for (auto entry = json.begin(); entry != json.end(); ++entry) {
        if (entry != json.begin()) out += ",\n";
        out += " " + json_text(entry.key()) + ": ";
        if (!entry->is_array()) {
            out += json_text(*entry);
            continue;
        }
        out += "[";
        for (std::size_t i = 0; i < entry->size(); ++i)
            out += (i ? ",\n  " : "\n  ") + json_text((*entry)[i]);
        out += "\n ]";
    }
    return out + "\n}\n";
}

std::vector<Phone> timed_phones(const std::vector<SplitPhone>& parts, std::int64_t start,
                                std::int64_t end) {
    std::vector<Phone> out;
    double share = 0;
    std::int64_t at = start;
    const auto length = static_cast<double>(end - start);
    for (std::size_t i = 0; i < parts.size(); ++i) {
        share += parts[i].share;
        const std::int64_t to = i + 1 == parts.size() ? end : start + std::llround(share * length);
        if (to <= at) continue;
        Phone phone;
        phone.symbol = parts[i].symbol;
        phone.length_mark = parts[i].length_mark;
        phone.stress = parts[i].stress;
        phone.start = at;
        phone.end = to;
        out.push_back(phone);
        at = to;
    }
    return out;
}

}  // namespace risorius::speech
