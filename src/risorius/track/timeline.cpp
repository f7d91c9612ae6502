// SPDX-License-Identifier: MIT
#include "risorius/track/timeline.h"

#include <algorithm>
#include <limits>

namespace risorius::track {

double expression_profile(const ExpressionEvent& event, double delay, double t_s) {
    const double begin_s = event.start_s + delay * event.onset_s;
    const double apex_s = event.start_s + event.onset_s;
    const double release_s = apex_s + event.hold_s;
    if (t_s < begin_s) return 0;
    if (t_s < apex_s) return minimum_jerk((t_s - begin_s) / (apex_s - begin_s));
    if (t_s < release_s) return 1;
    if (t_s < release_s + event.offset_s)
        return 1 - minimum_jerk((t_s - release_s) / event.offset_s);
    return 0;
}

Timeline::Timeline(const ScriptDescription& script, const ChannelTable& channels)
    : emg_(script.emg),
      expressions_(script.expressions),
      blinks_(script.blinks),
      others_(script.sources),
      pulls_(script.pulls),
      column_min_(channels.column_min()),
      late_s_(script.late_s) {
    if (script.weakness.size() > 0) strength_ = 1 - script.weakness.array();
    for (const MuscleChannel& muscle : channels.muscles) {
        const int left = channels.column(muscle.id, Side::kLeft),
                  right = channels.column(muscle.id, Side::kRight);
        if (left == right) continue;
        side_columns_[0].push_back(left);
        side_columns_[1].push_back(right);
    }
    for (const IdleEvent& idle : script.idle) idle_.emplace_back(idle);
    for (const ChannelTrack& channel : script.channels) {
        Curve curve(channel.keys, channel.interpolation);
        if (!channel.activation) {
            sources_.push_back({std::move(curve), channel.drives, channel.curve});
            continue;
        }
        DirectActivation direct{curve, channel.curve.muscles, {}};
        for (int column = 0; column < channel.drives.excitation.size(); ++column)
            if (const double share = channel.drives.excitation[column]; share != 0)
                direct.columns.emplace_back(column, share);
        activations_.push_back(std::move(direct));
        // Jaw, eyes and tongue have no activation. They move as they do otherwise.
        Expansion placed = Expansion::none(channels);
        placed.kinematic = channel.drives.kinematic;
        if (placed.kinematic != KinematicValues{})
            sources_.push_back({std::move(curve), std::move(placed), {{}, channel.curve.channels}});
    }
}

Drive Timeline::at(double t_s) const {
    Drive drive = together_at(t_s);
    for (std::size_t side = 0; side < 2; ++side) {
        if (late_s_[side] == 0) continue;
        const Drive earlier = together_at(t_s - late_s_[side]);
        for (const int column : side_columns_[side]) {
            drive.excitation[column] = earlier.excitation[column];
            drive.activation[column] = earlier.activation[column];
        }
    }
    if (strength_.size() > 0) {
        drive.excitation.array() *= strength_.array();
        drive.activation.array() *= strength_.array();
    }
    drive.pulls = pulls_at(pulls_, t_s);
    return drive;
}

Expansion Timeline::weakened(const Expansion& drives, double t_s) const {
    Eigen::VectorXd factor = Eigen::VectorXd::Ones(drives.excitation.size());
    for (const auto& other : others_) other->weaken_expressions(t_s, factor);
    Expansion out = drives;
    out.excitation = out.excitation.cwiseProduct(factor);
    return out;
}

Drive Timeline::together_at(double t_s) const {
    Expansion sum;
    sum.excitation = Eigen::VectorXd::Zero(column_min_.size());

    // Sources that are added.
    for (const Source& source : sources_)
        sum.add(source.drives, source.intensity, source.curve.at(t_s));
    for (const EmgTrack& emg : emg_) sum.add(emg.drives, emg.excitation.at(t_s));
    for (const ExpressionEvent& event : expressions_)
        for (const ExpressionEvent::Part& part : event.parts)
            if (const double fraction = expression_profile(event, part.delay, t_s); fraction > 0) {
                const double intensity = fraction * part.intensity;
                if (others_.empty())
                    sum.add(part.drives, part.curve, intensity);
                else
                    sum.add(weakened(part.drives, t_s), part.curve, intensity);
            }
    for (const BlinkEvent& blink : blinks_) {
        const double end_s = blink.start_s + blink.duration_s - kBlinkReopening_s;
        if (t_s < blink.start_s || t_s >= end_s) continue;
        const bool fires = t_s >= blink.start_s + kBlinkLead_s;
        // The loss of drive (levator) precedes the new drive (orbicularis).
        sum.excitation += fires ? blink.drives.excitation
                                : Eigen::VectorXd(blink.drives.excitation.cwiseMin(0.0));
    }

    for (const IdleMotion& idle : idle_) {
        const KinematicValues values = idle.at(t_s);
        for (std::size_t k = 0; k < values.size(); ++k) sum.kinematic[k] += values[k];
    }

    for (const auto& other : others_) other->add(t_s, sum);

    // Limits to what a face can do.
    Drive drive;
    drive.excitation = sum.excitation.cwiseMax(column_min_).cwiseMin(1.0);
    for (std::size_t k = 0; k < drive.kinematic.size(); ++k)
        drive.kinematic[k] =
            std::clamp(sum.kinematic[k], kinematic_channels()[k].min, kinematic_channels()[k].max);

    // Activation that is set directly: several tracks of one muscle are added, too.
    constexpr double kUnset = std::numeric_limits<double>::quiet_NaN();
    drive.activation = Eigen::VectorXd::Constant(column_min_.size(), kUnset);
    for (const DirectActivation& direct : activations_) {
        const double activation = direct.intensity.activation(direct.curve.at(t_s));
        for (const auto& [column, share] : direct.columns) {
            double& value = drive.activation[column];
            value = (value == value ? value : 0.0) + share * activation;
        }
    }
    for (long column = 0; column < drive.activation.size(); ++column)
        if (double& value = drive.activation[column]; value == value)
            value = std::clamp(value, column_min_[column], 1.0);
    return drive;
}

}  // namespace risorius::track
