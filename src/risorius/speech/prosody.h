// SPDX-License-Identifier: MIT
/// \file
/// What else a talking face does: brows and head move with stress, the head sinks at the end of a sentence, eyes blink in pauses and
/// look away as a sentence begins (gaze.h).
///
/// Brows lead, the head follows. A brow raise begins 100 ms before its word and is at its peak on the stressed vowel. A nod begins
/// with the vowel and is at its peak 120 ms later. Blinks come in pauses and at the ends of sentences, and never within 100 ms of
/// the burst of a lip closure, from which they would draw the eye.
///
/// Sources: J. Kim, E. Cvejic, C. Davis 2014, Speech Commun. 57, 317-330 (brows and head); A. R. Bentivoglio et al. 1997, Mov. Disord.
/// 12, 1028-1034 (26 blinks a minute while talking). Sizes are estimates.
#pragma once

#include <cstdint>
#include <vector>

#include "risorius/speech/gaze.h"
#include "risorius/speech/phone_table.h"
#include "risorius/speech/utterance.h"

namespace risorius::speech {

struct ProsodyOptions {
    double gestures = 0;  ///< of brows and head, [0, 2]; 0: none
    double blinks = 0;    ///< of the rate of 26 a minute, [0, 2]
    double gaze = 0;      ///< of the angles of gaze.h, [0, 2]
    std::uint64_t seed = 1;
};

/// A movement that rises and falls along minimum-jerk curves.
struct Gesture {
    enum class Kind { kBrow, kNod } kind;
    double start_s, peak_s, end_s;  ///< from the first sample of the sound
    double size;                    ///< brows: intensity of AU1 and AU2; nod: degrees downwards
    double at(double t_s) const;    ///< 0 outside
};

struct Prosody {
    std::vector<Gesture> gestures;
    std::vector<double> blinks_s;  ///< when they start
    std::vector<GazeShift> gaze;
};

Prosody prosody_of(const Utterance& utterance, const PhoneTable& table,
                   const ProsodyOptions& options);

}  // namespace risorius::speech
