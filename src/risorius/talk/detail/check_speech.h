// SPDX-License-Identifier: MIT
/// \file
/// Whether a simulated face does what speech asks of it: simulates a script without pictures, measures the mouth, and tests every
/// closure of the lips.
#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "risorius/face/face.h"
#include "risorius/talk/detail/mouth_measures.h"
#include "risorius/talk/say_event.h"
#include "risorius/track/timeline.h"

namespace risorius::talk {

/// The mouth over time, in steps of kMouthStep_s from time 0.
struct MouthTrack {
    std::vector<double> time_s;
    std::vector<Mouth> mouths;
    double at(double t_s, double Mouth::*measure) const;  ///< linear between samples
};
inline constexpr double kMouthStep_s = 1.0 / 240;

/// Simulates from 0 to the end. The face must be set up as the script says (jaw, gravity, motion).
MouthTrack simulate_mouth(face::Face& face, const track::Timeline& timeline, double duration_s,
                          const MouthMeasures& measures,
                          const std::function<void(double fraction)>& report = {});

/// Lips are in contact below this gap, mm.
inline constexpr double kContactGap_mm = 0.3;
/// By how much they may meet too early or too late, and part too late, s.
inline constexpr double kEarly_s = 0.025, kLate_s = 0.010, kOpensLate_s = 0.017;

/// One closure of the lips as simulated. Times are those of the script, s.
struct ClosureCheck {
    int phone = 0;
    double closure_s = 0, release_s = 0;  ///< in the sound
    double max_gap_mm = 0;                ///< from the closure + 10 ms to the release - 5 ms
    double least_gap_mm = 0;              ///< of the whole closure
    double contact_s = 0, open_s = 0;     ///< NaN: none
    /// When the contact ends; `open_s` is a little later, when the lips are seen to be apart. NaN: unknown
    double closed_until_s = std::numeric_limits<double>::quiet_NaN();
    bool from_rest = false;  ///< the first sound after a pause: the lips were shut before
    bool reached() const { return least_gap_mm < kContactGap_mm; }
    bool held() const { return max_gap_mm < kContactGap_mm; }
    /// Whether the lips meet when they should: not much before the closure in the sound, and not much after it.
    bool in_time() const {
        return contact_s <= closure_s + kLate_s && (from_rest || contact_s >= closure_s - kEarly_s);
    }
    /// Whether they part soon after the release.
    bool opened() const { return open_s <= release_s + kOpensLate_s; }
};

std::vector<ClosureCheck> check_closures(const MouthTrack& track, const PlacedUtterance& placed);

/// One vowel as simulated.
struct VowelCheck {
    int phone = 0;
    double planned_mm = 0, reached_mm = 0;  ///< largest gap between the lips
};

/// Vowels beside a closure are left out: wider ones would open it.
std::vector<VowelCheck> check_vowels(const MouthTrack& track, const PlacedUtterance& placed,
                                     const speech::PhoneTable& table);

/// Asks vowels in which the lips open too little to open further, by a part of what is missing.
std::vector<speech::ClosureChange> widened(const std::vector<VowelCheck>& checks,
                                           std::vector<speech::ClosureChange> before);

/// What most closures need beyond the plan, so that the first simulation is near the end: 2 mm deeper.
std::vector<speech::ClosureChange> usual_changes(const speech::Utterance& utterance,
                                                 const speech::PhoneTable& table);

/// What would mend the closures that leak, come late, or open late or early: deeper by twice the gap and 0.6 mm, earlier by twice
/// what is missing, shorter or longer by the error of the release. Added to the changes that were in force.
std::vector<speech::ClosureChange> changes_for(const std::vector<ClosureCheck>& checks,
                                               std::vector<speech::ClosureChange> before);

/// Of each closure, the changes with which it was best in the simulations so far.
class TriedClosures {
  public:
    void add(const std::vector<ClosureCheck>& checks,
             const std::vector<speech::ClosureChange>& changes);
    /// What to try after `last`: changes_for(), but half-way back to the best where `last` was worse, and the best where all is well.
    std::vector<speech::ClosureChange> next(const std::vector<ClosureCheck>& checks,
                                            const std::vector<speech::ClosureChange>& last) const;
    /// All of them together, with the changes of vowels that belong to them.
    std::vector<speech::ClosureChange> best() const;

  private:
    struct Tried {
        ClosureCheck check;
        speech::ClosureChange change, before;  ///< of the closure, and of the sound before it
    };
    std::vector<Tried> best_;
};

/// The table OUT.speech.tsv: a row for each phone, with its times in the script and in samples, and what the mouth did.
std::string speech_table(const MouthTrack& track, const std::vector<PlacedUtterance>& utterances,
                         const speech::PhoneTable& table);

}  // namespace risorius::talk
