// SPDX-License-Identifier: MIT
/// \file
/// When each phone asks for which place of jaw, lips and tongue, how much it matters, and what must hold.
///
/// A window is an interval in which a parameter is pulled to its target. Outside of windows nothing is asked, which is
/// coarticulation: there a curve is on its way from one target to the next. A bound holds at every moment of its interval.
///
///   tau   time constant of a window, s: the smaller, the more its target counts (trajectory.h)
///
/// Sources: P. Keating 1990, UCLA Working Papers in Phonetics 69 (windows); S. Ohman 1966, J. Acoust. Soc. Am. 39, 151-168
/// (consonants on a base of vowels); A. Lofqvist & V. Gracco 1997, J. Acoust. Soc. Am. 102, 877-893 (lips press in closures); P. Edwards et
/// al. 2016, ACM Trans. Graph. 35(4) (JALI: style of jaw and lips); P. Keating et al. 1994, J. Phonetics 22, 407-422 (the jaw is high in
/// s and t whatever the vowels are, lower in l, and free in h). The time constants are estimates of this project.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "risorius/speech/phone_table.h"
#include "risorius/speech/utterance.h"

namespace risorius::speech {

/// How something is said. Field names are the keys of "style" in a script.
struct SpeechStyle {
    /// Scales the targets of the jaw, and what the jaw adds to the gap, [0, 2]. Bounds are never scaled.
    double jaw = 1;
    double lips = 1;  ///< the same for width, protrusion and what the lips add to the gap, [0, 2]
    double anticipation = 1;  ///< scales the time constants, [0.5, 2]
};

struct Window {
    Parameter parameter;
    double from_s, to_s;
    double target;  ///< in the unit of the parameter
    double tau_s;
    bool weak =
        false;       ///< the phone leaves this parameter to its neighbours, such as the lips in t
    int phone = -1;  ///< index in the utterance; -1 before and after it
};

struct Bound {
    Parameter parameter;
    double from_s, to_s;
    double min, max;  ///< may be infinite
    int phone = -1;
};

/// A closure of the lips: one p, b or m, or several in a row.
struct LipClosure {
    int first_phone, last_phone;
    double closure_s, release_s;  ///< in the sound
};

/// Contact of the lower lip with the upper incisors.
struct LabiodentalContact {
    double from_s, to_s;
    double strength = 1;  ///< 1 for f and v, 0.6 for Finnish v
    int phone;
};

/// A change of one closure or vowel, as a check of the simulated face asks for it.
struct ClosureChange {
    int phone = 0;         ///< index of the first phone of the closure, or of the vowel
    double deeper_mm = 0;  ///< the lips press by this more, >= 0
    double earlier_s = 0;  ///< they begin to close earlier by this, >= 0
    /// They begin to open earlier by this, and are apart soon after the release; below 0: later
    double shorter_s = 0;
    double wider_mm = 0;  ///< of a vowel: the lips are asked to open by this more, >= 0
};

/// Everything that is asked of the mouth. Times are from the first sample of the sound, s.
struct ArticulationTargets {
    double start_s, end_s;  ///< where the curves begin and end, at rest
    std::vector<Window> windows;
    std::vector<Bound> bounds;
    std::vector<LipClosure> closures;
    std::vector<LabiodentalContact> contacts;
};

/// How long a face moves before the first sound and after the last one.
inline constexpr double kLead_s = 0.3, kTail_s = 0.35;
/// Only pauses longer than this close the mouth.
inline constexpr double kClosingPause_s = 0.26;
/// The gap in a closure is at most this, mm: the lips press.
inline constexpr double kClosedGap_mm = -0.5;
/// A closure holds from its beginning + kAfterClosure_s to its release - kBeforeRelease_s.
inline constexpr double kAfterClosure_s = 0.010, kBeforeRelease_s = 0.018;
/// Height of the tongue body in k, g and the like: it presses on the palate, as lips press, higher than in the closest vowel (1).
inline constexpr double kPressedBody = 1.25;

/// Throws Error for a symbol that `table` does not know.
ArticulationTargets targets_of(const Utterance& utterance, const PhoneTable& table,
                               const SpeechStyle& style = {});

/// When a stop or nasal is released, s: as the utterance says, or by the kind of phone.
double release_s(const Utterance& utterance, const Phone& phone, const PhoneEntry& entry);

/// The release of the first stop, lip closure or nasal, s from the first sample of the sound; none without such a phone.
std::optional<double> first_burst_s(const Utterance& utterance, const PhoneTable& table);

/// Changes the windows and bounds of closures, and the gap of vowels. Changes of phones that begin no closure and are no vowel have no
/// effect.
void change_closures(const std::vector<ClosureChange>& changes, ArticulationTargets& targets);

}  // namespace risorius::speech
