// SPDX-License-Identifier: MIT
#include "risorius/talk/spoken_input.h"

#include <cstdio>

#include "risorius/core/error.h"
#include "risorius/media/mono_sound.h"
#include "risorius/speech/landmarks.h"
#include "risorius/speech/trajectory.h"
#include "risorius/speech/windows.h"
#include "risorius/talk/recording.h"

namespace risorius::talk {

namespace {

SpokenResult of_labels(const SpokenInput& input, const speech::PhoneTable& table) {
    SpokenResult out;
    int rate_hz = kSilentRate_hz;
    std::optional<std::int64_t> samples;
    if (!input.audio.empty()) {
        media::MonoSound sound = media::read_mono_sound(input.audio);
        rate_hz = sound.rate_hz;
        samples = static_cast<std::int64_t>(sound.samples.size());
        out.spoken.sound = std::move(sound.samples);
        out.sound_file = input.audio;
    }
    out.spoken.utterance = speech::utterance_of_labels(
        speech::read_labels(input.labels, input.label_format, rate_hz), input.label_options, table,
        rate_hz, samples, input.labels.string());
    out.spoken.utterance.sound = out.sound_file;
    if (samples)
        speech::find_landmarks(out.spoken.utterance, out.spoken.sound, table,
                               speech::StopMark::kClosure);
    return out;
}

SpokenResult of_utterance(const SpokenInput& input, const speech::PhoneTable& table) {
    SpokenResult out;
    out.spoken.utterance = speech::read_utterance(input.utterance, table);
    out.sound_file = input.audio.empty() ? out.spoken.utterance.sound : input.audio;
    if (out.sound_file.empty()) return out;
    media::MonoSound sound = media::read_mono_sound(out.sound_file);
    if (sound.rate_hz != out.spoken.utterance.rate_hz)
        throw Error(out.sound_file.string(),
                    "sound of " + std::to_string(out.spoken.utterance.rate_hz) +
                        " Hz, the rate of " + input.utterance.string(),
                    std::to_string(sound.rate_hz));
    out.spoken.sound = std::move(sound.samples);
    return out;
}

/// A recording of the text of the voice.
SpokenResult of_recording(const SpokenInput& input, const speech::PhoneTable& table) {
    AlignedRecording aligned = align_recording(input.audio, input.voice, table);
    SpokenResult out;
    out.spoken = {std::move(aligned.alignment.utterance), std::move(aligned.sound), 0};
    out.spoken.utterance.sound = out.sound_file = input.audio;
    return out;
}

}  // namespace

SpokenResult read_spoken(const SpokenInput& input, const speech::PhoneTable& table) {
    const int kinds = !input.labels.empty() + !input.utterance.empty() +
                      !(input.voice.text.empty() && input.voice.phones.empty());
    if (kinds != 1)
        throw Error(option_name("text"), "a text, phones, an utterance or labels",
                    kinds == 0 ? "none" : "several");
    if (!input.labels.empty()) return of_labels(input, table);
    if (!input.utterance.empty()) return of_utterance(input, table);
    if (!input.audio.empty()) return of_recording(input, table);
    return {speak(input.voice, table), {}};
}

std::string curves_text(const speech::Utterance& utterance, const speech::PhoneTable& table) {
    const speech::ArticulationCurves curves =
        speech::curves_of(speech::targets_of(utterance, table));
    std::string out = "time_s\tphone";
    for (const std::string_view name : speech::parameter_names()) out += "\t" + std::string(name);
    out += "\tlabiodental\n";
    std::size_t phone = 0;
    char cell[48];
    for (long i = 0; i < curves.size(); ++i) {
        const double t = curves.time_s(i);
        while (phone < utterance.phones.size() &&
               utterance.seconds(utterance.phones[phone].end) <= t)
            ++phone;
        std::snprintf(cell, sizeof cell, "%.3f", t);
        out += cell;
        const bool within = phone < utterance.phones.size() &&
                            utterance.seconds(utterance.phones[phone].start) <= t;
        out += "\t" + (within ? utterance.phones[phone].text() : std::string(speech::kPause));
        for (const Eigen::VectorXd& values : curves.values) {
            std::snprintf(cell, sizeof cell, "\t%.4f", values[i] + 0.0);
            out += cell;
        }
        std::snprintf(cell, sizeof cell, "\t%.4f\n", curves.labiodental[i]);
        out += cell;
    }
    return out;
}

}  // namespace risorius::talk
