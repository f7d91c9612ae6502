// SPDX-License-Identifier: MIT
/// \file
/// When a recording says each sound of a text that is known. A voice has spoken the text; the times of its phones are known. The
/// two sounds are warped onto each other (time_warp.h), and borders are moved to where the recording changes.
///
/// No model is trained, so that this works in every language that has a voice. On recordings that fit, half of the borders are
/// within 12 ms of those of the people that the voices were made of, and 70 to 80 % within 20 ms (docs/howto/speech.md).
#pragma once

#include <span>
#include <string>
#include <vector>

#include "risorius/speech/phone_table.h"
#include "risorius/speech/utterance.h"

namespace risorius::speech {

/// The longest recording, s.
inline constexpr double kLongestRecording_s = 120;
/// A word that fits worse than this many times the median is doubtful.
inline constexpr double kDoubtfulMisfit = 2;

/// How well one word of the recording fits the same word of the voice.
struct WordFit {
    double misfit = 1;  ///< mean distance of its frames, relative to the median of all words
    bool doubtful() const { return misfit > kDoubtfulMisfit; }
};

struct Alignment {
    Utterance utterance;         ///< of the recording, with its moments (landmarks.h)
    std::vector<WordFit> words;  ///< one for each word of the utterance
    /// Distance of the recording from the text, relative to that from the same sounds in another order. The text of the recording
    /// has 0.7 to 0.85, another one 0.93 and more.
    double misfit = 0;
    int pauses = 0;  ///< within the speech
};

/// One channel of sound at a rate.
struct SoundView {
    std::span<const float> samples;
    int rate_hz;
};

/// What a voice has said, with its sound.
struct SaidByVoice {
    const Utterance& utterance;
    SoundView sound;
    /// How much later the voice marks borders between voiced sounds that flow into each other than people do, s
    double late_s = 0;
};

/// Time of the sound that is speech, s: all but silences of 0.2 s and more. Throws Error with `place` for a sound that is silent,
/// shorter than 0.1 s, or longer than kLongestRecording_s.
double spoken_seconds(const SoundView& sound, const std::string& place);

/// Aligns a recording with what a voice has said. Throws Error with `place` for a recording that spoken_seconds()
/// refuses, that is less than a third or more than three times as long as what the voice said, or that fits the text no better than
/// the same sounds in another order.
Alignment align(const SoundView& recording, const SaidByVoice& voice, const PhoneTable& table,
                const std::string& place);

}  // namespace risorius::speech
