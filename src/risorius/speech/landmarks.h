// SPDX-License-Identifier: MIT
/// \file
/// Moments of consonants in the sound: when a closure begins, when it is released, when the voice begins.
///
/// Synthesisers and people label stops differently. espeak-ng marks a voiceless stop at its burst, and counts the silence of its
/// closure to the sound before; aligners and people mark the closure. The silence itself tells: the sound there is more than 35 dB
/// below its loudest 5 ms.
///
/// In recordings, the release is the steepest rise of the energy above 3 kHz in the last part of the label.
#pragma once

#include <span>

#include "risorius/speech/phone_table.h"
#include "risorius/speech/utterance.h"

namespace risorius::speech {

/// What the start of a voiceless stop means in the labels.
enum class StopMark {
    kBurst,    ///< the release, as in the events of espeak-ng
    kClosure,  ///< the closure, as in labels of aligners and people
};

/// Level below the loudest 5 ms that counts as silence, dB.
inline constexpr double kSilence_db = 35;

/// Sets closure, release and voice_onset of stops, nasals and affricates. With kBurst, the borders between phones are moved: a stop
/// begins with its closure. `sound`: one channel at the utterance's rate.
void find_landmarks(Utterance& utterance, std::span<const float> sound, const PhoneTable& table,
                    StopMark mark);

}  // namespace risorius::speech
