// SPDX-License-Identifier: MIT
#include "tools/risorius/studio_sound.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>

#include "risorius/core/input_log.h"
#include "risorius/core/json_object.h"
#include "risorius/core/json_text.h"
#include "risorius/media/mono_sound.h"

namespace risorius::cli {

namespace {

void append_little_endian(std::string& bytes, std::uint32_t value, int count) {
    for (int i = 0; i < count; ++i) bytes += static_cast<char>(value >> (8 * i) & 0xff);
}

/// A WAV file in memory.
std::string wav_in_memory(const media::MonoSound& sound) {
    constexpr std::uint32_t kHead = 36, kPcm = 1, kBytes = 2;
    const auto size = static_cast<std::uint32_t>(kBytes * sound.samples.size());
    const auto rate_hz = static_cast<std::uint32_t>(sound.rate_hz);
    std::string bytes = "RIFF";
    append_little_endian(bytes, kHead + size, 4);
    bytes += "WAVEfmt ";
    append_little_endian(bytes, 16, 4);
    append_little_endian(bytes, kPcm, 2);
    append_little_endian(bytes, 1, 2);  // channel
    append_little_endian(bytes, rate_hz, 4);
    append_little_endian(bytes, kBytes * rate_hz, 4);
    append_little_endian(bytes, kBytes, 2);
    append_little_endian(bytes, 8 * kBytes, 2);
    bytes += "data";
    append_little_endian(bytes, size, 4);
    for (const float sample : sound.samples) {
        const auto value = static_cast<std::int16_t>(
            std::lround(32767.0 * std::clamp(static_cast<double>(sample), -1.0, 1.0)));
        append_little_endian(bytes, static_cast<std::uint16_t>(value), 2);
    }
    return bytes;
}

double rounded_s(double s) { return std::round(1e4 * s) / 1e4; }

}  // namespace

ScriptSound sound_of(const talk::PlannedSpeech& speech) {
    Json phones = Json::array(), words = Json::array();
    for (const talk::PlacedUtterance& placed : speech.utterances) {
        const speech::Utterance& utterance = placed.utterance;
        const auto at = [&](std::int64_t sample) {
            return rounded_s(placed.start_s + utterance.seconds(sample));
        };
        for (const speech::Phone& phone : utterance.phones)
            if (!phone.is_pause())
                phones.push_back(Json::array({phone.text(), at(phone.start), at(phone.end)}));
        for (const speech::Span& word : utterance.words)
            words.push_back(Json::array({word.text, at(word.start), at(word.end)}));
    }
    ScriptSound out;
    double start_s = 0;
    if (!speech.sound_file.empty()) {
        std::optional<ReadingFormerOutput> own_file;
        if (speech.keeps) own_file.emplace();
        const media::MonoSound sound = media::read_mono_sound(speech.sound_file);
        start_s = static_cast<double>(speech.sound_offset_samples) / sound.rate_hz;
        out.wav = std::make_shared<const std::string>(wav_in_memory(sound));
    }
    out.message = json_text(json_object({{"type", "speech"},
                                         {"start_s", rounded_s(start_s)},
                                         {"sound", out.wav != nullptr},
                                         {"phones", phones},
                                         {"words", words}}));
    return out;
}

bool same_sound(const ScriptSound& a, const ScriptSound& b) {
    if (a.message != b.message || !a.wav != !b.wav) return false;
    return !a.wav || *a.wav == *b.wav;
}

}  // namespace risorius::cli
