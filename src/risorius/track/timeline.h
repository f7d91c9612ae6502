// SPDX-License-Identifier: MIT
/// \file
/// Evaluates a script at any time: the drive of every muscle, the jaw, the eyes and the head.
///
/// The sources of a muscle or channel are added, and the sum is clamped to its range. A blink is two pulses of AU45: the
/// levator of the lid becomes silent, 10 ms later orbicularis oculi fires, and both pulses end together. With activation
/// dynamics, the lids meet after 70 to 80 ms and are open again at the end of the blink. The muscles of a side may be delayed,
/// and any muscle may be weak. Both also apply to activation that is set directly.
///
/// Source for blinks: VanderWerf et al. 2003, J. Neurophysiol. 89, 2784-2796 (down phase 66-78 ms, up phase 120-200 ms).
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "risorius/track/detail/curve.h"
#include "risorius/track/script.h"

namespace risorius::track {

/// Time from the silence of the levator to the start of orbicularis.
inline constexpr double kBlinkLead_s = 0.010;
/// Time from the end of the pulses until the lids are open again.
inline constexpr double kBlinkReopening_s = 0.140;
/// The smallest duration of a blink; a shorter one would end before orbicularis fires.
inline constexpr double kShortestBlink_s = 0.160;

/// Evaluates a script.
class Timeline {
  public:
    Timeline(const ScriptDescription& script, const ChannelTable& channels);

    /// Returns the drive at a time, within microseconds. Call it at every simulation step, because a blink is short, and steps
    /// above 5 ms blur it.
    Drive at(double t_s) const;

  private:
    /// Returns the drive without the delays of the sides (ScriptDescription::late_s).
    Drive together_at(double t_s) const;
    /// What other sources leave of an expression.
    Expansion weakened(const Expansion& drives, double t_s) const;
    struct Source {
        Curve curve;
        Expansion drives;
        UnitCurves intensity;
    };
    struct DirectActivation {
        Curve curve;
        IntensityCurve intensity;
        std::vector<std::pair<int, double>> columns;  ///< of muscles, with their shares
    };

    std::vector<Source> sources_;
    std::vector<EmgTrack> emg_;
    std::vector<DirectActivation> activations_;
    std::vector<ExpressionEvent> expressions_;
    std::vector<BlinkEvent> blinks_;
    std::vector<IdleMotion> idle_;
    std::vector<std::shared_ptr<const DriveSource>> others_;
    std::vector<PullTrack> pulls_;
    Eigen::VectorXd column_min_;
    Eigen::VectorXd strength_;  ///< per column; empty: all muscles have full strength
    std::array<double, 2> late_s_;
    std::array<std::vector<int>, 2> side_columns_;  ///< columns of paired muscles
};

/// Returns the fraction of its intensity that a unit of an expression has at t: 0 before its delayed onset, 1 while it is held, 0
/// after the offset.
double expression_profile(const ExpressionEvent& event, double delay, double t_s);

}  // namespace risorius::track
