// SPDX-License-Identifier: MIT
/// \file
/// What a face is to say: a text for a voice, a recording with its text, a stored utterance, or labels with a recording.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "risorius/speech/labels.h"
#include "risorius/talk/voice.h"

namespace risorius::talk {

/// One of voice (its text or phones), utterance and labels.
struct SpokenInput {
    VoiceRequest voice;
    std::filesystem::path utterance;  ///< a file of format risorius-utterance
    std::filesystem::path labels;
    std::string label_format;  ///< empty: found by the file
    speech::LabelOptions label_options;
    /// The recording of the labels, or of the text; with an utterance, instead of the sound that it names. May be empty.
    std::filesystem::path audio;
};

/// Rate at which labels are read when there is no sound, samples per second: every millisecond, and frames at 25, 30 and 60 per second,
/// are whole samples.
inline constexpr int kSilentRate_hz = 48000;

struct SpokenResult {
    Spoken spoken;
    /// Where the sound is; empty for that of a voice, which is only in Spoken::sound, and for none.
    std::filesystem::path sound_file;
};

/// Reads or makes the utterance, and finds the landmarks in its sound. Throws Error.
SpokenResult read_spoken(const SpokenInput& input, const speech::PhoneTable& table);

/// Curves of an utterance as a table: one row each 5 ms, from the first sample of the sound.
std::string curves_text(const speech::Utterance& utterance, const speech::PhoneTable& table);

}  // namespace risorius::talk
