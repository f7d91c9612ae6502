// SPDX-License-Identifier: MIT
/// \file
/// Noise with the long-term spectrum of speech: white noise through the all-pole filter that linear prediction finds in the speech
/// (J. Makhoul 1975, Proc. IEEE 63, 561-580). It masks speech evenly, so that a ratio of levels says how much is heard.
#pragma once

#include <cstdint>
#include <vector>

#include "risorius/speech/utterance.h"

namespace risorius::talk {

/// How long noise begins before the speech and lasts after it, and how long it takes to come and go, s.
inline constexpr double kNoiseAround_s = 0.5, kNoiseRamp_s = 0.02;

struct NoisySpeech {
    std::vector<float> samples;
    std::int64_t before = 0;  ///< samples of noise before the first one of the speech
    double gain = 1;  ///< below 1: the mixture was made quieter, because it would have been cut off
};

/// Adds noise. `snr_db`: level of the speech without its pauses over that of the noise (RMS). The same seed gives the same noise.
NoisySpeech with_noise(const std::vector<float>& sound, const speech::Utterance& utterance,
                       double snr_db, std::uint64_t seed);

}  // namespace risorius::talk
