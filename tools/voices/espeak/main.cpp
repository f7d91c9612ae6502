// SPDX-License-Identifier: GPL-3.0-or-later
// A voice: text to sound and a table of phones, by libespeak-ng. See README.md.
#include <espeak-ng/speak_lib.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace {

struct Row {
    const char* kind;
    long sample;
    int char_start, char_length;
    std::string symbol;
};

std::vector<short> sound;
std::vector<Row> rows;

/// A name of up to 8 bytes, without a zero when it has all of them; a character that was cut at its end is left out.
std::string name_of(const espeak_EVENT& event) {
    std::string name(event.id.string, strnlen(event.id.string, sizeof event.id.string));
    std::size_t begin = name.size();
    while (begin > 0 && (static_cast<unsigned char>(name[begin - 1]) & 0xc0) == 0x80) --begin;
    if (begin > 0) {
        const auto lead = static_cast<unsigned char>(name[begin - 1]);
        const std::size_t size = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : lead >= 0xc0 ? 2 : 1;
        if (name.size() - (begin - 1) < size) name.resize(begin - 1);
    }
    return name;
}

int take(short* samples, int count, espeak_EVENT* events) {
    for (; events->type != espeakEVENT_LIST_TERMINATED; ++events) {
        const int start = events->text_position, length = events->length;
        switch (events->type) {
            case espeakEVENT_PHONEME:
                rows.push_back({"phone", events->sample, start, length, name_of(*events)});
                break;
            case espeakEVENT_WORD:
                rows.push_back({"word", events->sample, start, length, ""});
                break;
            case espeakEVENT_SENTENCE:
                rows.push_back({"sentence", events->sample, start, length, ""});
                break;
            default:
                break;
        }
    }
    if (samples && count > 0) sound.insert(sound.end(), samples, samples + count);
    return 0;
}

void put(std::string& out, std::uint32_t value, int bytes) {
    for (int i = 0; i < bytes; ++i) out += static_cast<char>(value >> (8 * i) & 0xff);
}

std::string wav_of(int rate_hz) {
    const auto bytes = static_cast<std::uint32_t>(2 * sound.size());
    std::string out = "RIFF";
    put(out, 36 + bytes, 4);
    out += "WAVEfmt ";
    put(out, 16, 4);
    put(out, 1, 2);  // PCM
    put(out, 1, 2);  // one channel
    put(out, static_cast<std::uint32_t>(rate_hz), 4);
    put(out, static_cast<std::uint32_t>(2 * rate_hz), 4);
    put(out, 2, 2);
    put(out, 16, 2);
    out += "data";
    put(out, bytes, 4);
    for (const short one : sound) put(out, static_cast<std::uint16_t>(one), 2);
    return out;
}

int fail(const std::string& message) {
    std::fprintf(stderr, "%s\n", message.c_str());
    return 2;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 4) return fail("risorius-voice-espeak REQUEST.json OUT.wav OUT.tsv");
    std::ifstream in(argv[1], std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    const nlohmann::json request = nlohmann::json::parse(text, nullptr, false);
    if (!request.is_object()) return fail(std::string(argv[1]) + ": expected a JSON object");
    std::string said, language = "en-us";
    int words_per_minute = espeakRATE_NORMAL, pitch = 50;
    try {
        language = request.value("language", language);
        words_per_minute = request.value("words_per_minute", words_per_minute);
        pitch = request.value("pitch", pitch);
        said = request.contains("phones") ? "[[" + request.at("phones").get<std::string>() + "]]"
                                          : request.at("text").get<std::string>();
    } catch (const nlohmann::json::exception& error) {
        return fail(std::string(argv[1]) + ": " + error.what());
    }
    // Nothing is played. Without this, the library would look for a sound server, and leave a folder of it behind.
    ::setenv("PULSE_SERVER", "", 1);
    constexpr int kPhonemeEvents = 1, kIpaNames = 2, kDoNotExit = 0x8000, kIpa = 2;
    const int rate_hz = espeak_Initialize(AUDIO_OUTPUT_SYNCHRONOUS, 0, nullptr,
                                          kPhonemeEvents | kIpaNames | kDoNotExit);
    if (rate_hz <= 0) return fail("espeak-ng cannot be initialised: is espeak-ng-data installed?");
    if (espeak_SetVoiceByName(language.c_str()) != EE_OK)
        return fail("language: expected a voice of espeak-ng --voices, found \"" + language + "\"");
    espeak_SetParameter(espeakRATE, words_per_minute, 0);
    espeak_SetParameter(espeakPITCH, pitch, 0);
    espeak_SetSynthCallback(take);
    const unsigned flags = espeakCHARS_UTF8 | espeakPHONEMES | espeakENDPAUSE;
    if (espeak_Synth(said.c_str(), said.size() + 1, 0, POS_CHARACTER, 0, flags, nullptr, nullptr) !=
            EE_OK ||
        espeak_Synchronize() != EE_OK)
        return fail("espeak-ng cannot speak this text");
    rows.push_back({"end", static_cast<long>(sound.size()), 0, 0, ""});
    const void* rest = said.c_str();
    while (rest) {
        const char* clause = espeak_TextToPhonemes(&rest, espeakCHARS_UTF8, kIpa);
        if (clause) rows.push_back({"ipa", 0, 0, 0, clause});
    }
    std::ofstream(argv[2], std::ios::binary) << wav_of(rate_hz);
    std::ofstream table(argv[3], std::ios::binary);
    table << "kind\tsample\tchar_start\tchar_length\tsymbol\n";
    for (const Row& row : rows)
        table << row.kind << '\t' << row.sample << '\t' << row.char_start << '\t' << row.char_length
              << '\t' << row.symbol << '\n';
    table << "# espeak-ng " << espeak_Info(nullptr) << '\n';
    table.close();
    return table ? 0 : 1;
}
