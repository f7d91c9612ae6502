// SPDX-License-Identifier: MIT
/// \file
/// The 15 visemes of Oculus for other programs: which mouth shape is when, and how much of each there is over time.
///
/// The weights w of the visemes at a moment minimise
///
///   |S (sum w_i T_i - y)|^2 + sum c_i w_i + ridge |w|^2,   w >= 0, sum w = 1
///
///   y     jaw, lips and tongue as the curves have them (trajectory.h)
///   T_i   place of viseme i, that of its phone in the table; the viseme of silence is the face at rest
///   S     weights of the parameters
///   c_i   small for visemes of the phones that are near in time, large for others
///
/// so that they show what curves show: rounding before its vowel, half-opened short vowels, and mixtures for sounds that have no viseme
/// of their own. While the lips must be closed, PP is 1.
///
/// Source of the names: Meta, Viseme Reference of Oculus Lipsync.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "risorius/speech/phone_table.h"
#include "risorius/speech/trajectory.h"
#include "risorius/speech/utterance.h"

namespace risorius::speech {

inline constexpr std::size_t kVisemeCount = 15;
/// "sil", "PP", "FF", "TH", "DD", "kk", "CH", "SS", "nn", "RR", "aa", "E", "ih", "oh", "ou"
const std::array<std::string_view, kVisemeCount>& oculus_visemes();

/// The viseme of a phone, an index of oculus_visemes(). Of h and the glottal stop, which have the shape of what follows, it is -1.
int viseme_of(const PhoneEntry& phone);

/// A mouth shape with its time.
struct TimedViseme {
    int viseme;
    std::int64_t start, end;  ///< samples of the sound
};

/// One viseme for each phone but pauses. That of p, b and m lasts as long as the lips are closed. Neighbours with the same viseme
/// are one.
std::vector<TimedViseme> visemes_of(const Utterance& utterance, const PhoneTable& table);

/// Weights at the times from_s + k / rate_hz, `count` rows of 15; each row adds up to 1. Times are from the first sample of the sound.
/// `targets`: of the utterance, see targets_of().
Eigen::MatrixXd viseme_weights(const Utterance& utterance, const ArticulationTargets& targets,
                               const PhoneTable& table, double from_s, double rate_hz, long count);

/// A file of format risorius-visemes: what TalkingHead's speakAudio() takes, see docs/formats/visemes.md.
std::string visemes_text(const Utterance& utterance, const PhoneTable& table);

}  // namespace risorius::speech
