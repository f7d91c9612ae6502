// SPDX-License-Identifier: MIT
#include "risorius/talk/recording.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "risorius/media/mono_sound.h"

namespace risorius::talk {

namespace {

constexpr double kSlowest = 0.3, kFastest = 3;
// A voice that is this close to the speed of the recording need not speak again.
constexpr double kSameSpeed = 0.04;

std::string row(const char* kind, const std::string& text, const speech::Utterance& utterance,
                std::int64_t start, std::int64_t end) {
    char times[96];
    std::snprintf(times, sizeof times, "\t%.4f\t%.4f\t", utterance.seconds(start),
                  utterance.seconds(end));
    std::string shown = text;
    std::replace_if(
        shown.begin(), shown.end(), [](char c) { return c == '\t' || c == '\n' || c == '\r'; },
        ' ');
    return kind + std::string(times) + shown;
}

}  // namespace

AlignedRecording align_recording(const std::filesystem::path& file, VoiceRequest said,
                                 const speech::PhoneTable& table) {
    media::MonoSound sound = media::read_mono_sound(file);
    const speech::SoundView recording{sound.samples, sound.rate_hz};
    const double wanted_s = speech::spoken_seconds(recording, file.string());
    Spoken voice = speak(said, table);
    // A voice spoken twice as fast does not take half the time; the second try is close.
    const double spoken_s = speech::spoken_seconds({voice.sound, voice.utterance.rate_hz}, "voice");
    const double rate = std::clamp(said.rate * spoken_s / wanted_s, kSlowest, kFastest);
    AlignedRecording out;
    out.rate = said.rate;
    if (std::abs(std::log(rate / said.rate)) > kSameSpeed) {
        said.rate = out.rate = rate;
        voice = speak(said, table);
    }
    out.alignment = speech::align(
        recording, {voice.utterance, {voice.sound, voice.utterance.rate_hz}, voice.late_s}, table,
        file.string());
    out.sound = std::move(sound.samples);
    return out;
}

std::string alignment_report(const speech::Alignment& alignment) {
    const speech::Utterance& utterance = alignment.utterance;
    std::string out = "kind\tstart_s\tend_s\ttext\tmisfit\tdoubtful\n";
    char cell[48];
    for (std::size_t i = 0; i < utterance.words.size(); ++i) {
        const speech::Span& word = utterance.words[i];
        std::snprintf(cell, sizeof cell, "\t%.3f\t%d\n", alignment.words[i].misfit,
                      alignment.words[i].doubtful());
        out += row("word", word.text, utterance, word.start, word.end) + cell;
    }
    for (std::size_t i = 1; i + 1 < utterance.phones.size(); ++i)
        if (const speech::Phone& phone = utterance.phones[i]; phone.is_pause())
            out += row("pause", "", utterance, phone.start, phone.end) + "\t\t\n";
    std::snprintf(cell, sizeof cell, "\t%.3f\t\n", alignment.misfit);
    return out + row("all", "", utterance, 0, utterance.samples) + cell;
}

}  // namespace risorius::talk
