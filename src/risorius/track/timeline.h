// A script at any moment: what drives every muscle, the jaw, the eyes and the head.
//
// Sources for one muscle or channel add up and are clamped to its range. A blink is two pulses of AU45: the levator of the
// lid falls silent, 10 ms later orbicularis oculi fires, and both end together; through activation dynamics the lids meet
// after 70 to 80 ms and are open again at the end of the blink.
// Muscles of a side may be late and any of them weak: what they are driven with is what is left, also of activation set directly.
// Source of the blink: VanderWerf et al. 2003, J. Neurophysiol. 89, 2784-2796 (down phase 66-78 ms, up phase 120-200 ms).
#pragma once

#include <array>
#include <vector>

#include "risorius/track/detail/curve.h"
#include "risorius/track/script.h"

namespace risorius::track {

/// Orbicularis starts this long after the levator has fallen silent.
inline constexpr double kBlinkLead_s = 0.010;
/// Time the lids take to open again once the pulses have ended.
inline constexpr double kBlinkReopening_s = 0.140;
/// A shorter blink would end before orbicularis has fired.
inline constexpr double kShortestBlink_s = 0.160;

class Timeline {
  public:
    Timeline(const ScriptDescription& script, const ChannelTable& channels);

    /// Costs microseconds; call it at every simulation step. Blinks are sharp: steps above 5 ms blur them.
    Drive at(double t_s) const;

  private:
    /// Of a face whose sides hear of everything at once.
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

/// Share of an expression's unit that shows at t: 0 before its delayed onset, 1 while held, 0 after the offset.
double expression_profile(const ExpressionEvent& event, double delay, double t_s);

}  // namespace risorius::track
