// SPDX-License-Identifier: MIT
/// \file
/// A script at any moment: the drive of every muscle, the jaw, the eyes and the head.
///
/// Sources of one muscle or channel are added and clamped to its range. A blink is two pulses of AU45: the levator of the lid falls silent,
/// 10 ms later orbicularis oculi fires, and both end together. Through activation dynamics the lids meet after 70 to 80 ms and are open
/// again at the end of the blink. Muscles of a side may be delayed and any muscle may be weak; both also apply to activation set directly.
/// Source of the blink: VanderWerf et al. 2003, J. Neurophysiol. 89, 2784-2796 (down phase 66-78 ms, up phase 120-200 ms).
#pragma once

#include <array>
#include <vector>

#include "risorius/track/detail/curve.h"
#include "risorius/track/script.h"

namespace risorius::track {

/// Orbicularis starts this long after the levator has fallen silent.
inline constexpr double kBlinkLead_s = 0.010;
/// Time from the end of the pulses until the lids are open again.
inline constexpr double kBlinkReopening_s = 0.140;
/// A shorter blink would end before orbicularis fires.
inline constexpr double kShortestBlink_s = 0.160;

class Timeline {
  public:
    Timeline(const ScriptDescription& script, const ChannelTable& channels);

    /// Takes microseconds. Call it at every simulation step: a blink is short, and steps above 5 ms smear it.
    Drive at(double t_s) const;

  private:
    /// The drive without the delays of sides.
    Drive together_at(double t_s) const;
    struct Source {
        Curve curve;
        Expansion drives;
    };
    struct DirectActivation {
        Curve curve;
        std::vector<int> columns;
    };

    std::vector<Source> sources_;
    std::vector<EmgTrack> emg_;
    std::vector<DirectActivation> activations_;
    std::vector<ExpressionEvent> expressions_;
    std::vector<BlinkEvent> blinks_;
    std::vector<IdleMotion> idle_;
    Eigen::VectorXd column_min_;
    Eigen::VectorXd strength_;  ///< per column, or empty: all have their own
    std::array<double, 2> late_s_;
    std::array<std::vector<int>, 2> side_columns_;  ///< of paired muscles
};

/// Fraction of an expression's unit at t: 0 before its delayed onset, 1 while held, 0 after the offset.
double expression_profile(const ExpressionEvent& event, double delay, double t_s);

}  // namespace risorius::track
