// SPDX-License-Identifier: MIT
#include "risorius/talk/detail/speech_drive.h"

#include <algorithm>
#include <cmath>

#include "risorius/muscle/activation.h"

namespace risorius::talk {

namespace {

using speech::ArticulationCurves;
using speech::kCurveStep_s;
using speech::Parameter;

// Written with few digits, so that curves are the same with every compiler.
constexpr double kDigits = 1e4;
// At rest the tongue lies as the curves have it there.
constexpr double kRestTip = 0.2;
// Tongue tip height 1 is the channel tongue_up at this value: the tip at the ridge, not curled back.
constexpr double kTongueUp = 0.8;
// The body at rest, and what is 1 on the channels: on the palate, and at the soft palate.
constexpr double kRestBody = 0.3, kBackmost = 1;

// What is left of a smile while lips have to close.
constexpr double kExpressionInBounds = 0.15;
constexpr const char* kLipMuscles[] = {"orbicularis_oris_upper_peripheral",
                                       "orbicularis_oris_lower_peripheral",
                                       "orbicularis_oris_upper_marginal",
                                       "orbicularis_oris_lower_marginal",
                                       "incisivus_labii_superioris",
                                       "incisivus_labii_inferioris",
                                       "levator_labii_superioris_alaeque_nasi",
                                       "levator_labii_superioris",
                                       "levator_anguli_oris",
                                       "zygomaticus_minor",
                                       "zygomaticus_major",
                                       "risorius",
                                       "buccinator",
                                       "depressor_anguli_oris",
                                       "depressor_labii_inferioris",
                                       "mentalis"};
// Bounds come and go within this, s.
constexpr int kBoundRamp = 18;  // steps of 5 ms

/// One row: where a bound holds, with ramps on both sides.
Eigen::MatrixXd ramped(const Eigen::VectorXd& bounded) {
    Eigen::MatrixXd out = Eigen::MatrixXd::Zero(1, bounded.size());
    for (long i = 0; i < bounded.size(); ++i)
        for (long k = std::max(0L, i - kBoundRamp);
             k <= std::min(bounded.size() - 1, i + kBoundRamp); ++k)
            out(0, i) = std::max(out(0, i), bounded[k] * (1 - static_cast<double>(std::abs(k - i)) /
                                                                  (kBoundRamp + 1)));
    return out;
}

class SpeechDrive : public track::DriveSource {
  public:
    SpeechDrive(Eigen::MatrixXd excitation, double excitation_start_s, Eigen::MatrixXd channels,
                double channels_start_s, Eigen::MatrixXd bounded, std::vector<int> mouth)
        : excitation_(std::move(excitation)),
          channels_(std::move(channels)),
          bounded_(std::move(bounded)),
          mouth_(std::move(mouth)),
          excitation_start_s_(excitation_start_s),
          channels_start_s_(channels_start_s) {}

    void add(double t_s, track::Expansion& sum) const override {
        add_at(excitation_, t_s - excitation_start_s_,
               [&](long row, double value) { sum.excitation[row] += value; });
        static constexpr track::Kinematic kChannels[] = {
            track::Kinematic::kJawOpen, track::Kinematic::kTongueUp, track::Kinematic::kTongueOut,
            track::Kinematic::kTongueBodyUp, track::Kinematic::kTongueBodyBack};
        add_at(channels_, t_s - channels_start_s_, [&](long row, double value) {
            sum.kinematic[static_cast<std::size_t>(kChannels[row])] += value;
        });
    }

    void weaken_expressions(double t_s, Eigen::VectorXd& factor) const override {
        add_at(bounded_, t_s - excitation_start_s_, [&](long, double value) {
            for (const int column : mouth_) factor[column] *= 1 - (1 - kExpressionInBounds) * value;
        });
    }

  private:
    /// Linear between columns; 0 before the first and after the last one.
    template <class Use>
    static void add_at(const Eigen::MatrixXd& curves, double t_s, const Use& use) {
        const double place = t_s / kCurveStep_s;
        if (!(place >= 0) || place > static_cast<double>(curves.cols() - 1)) return;
        const long i = std::min(static_cast<long>(place), curves.cols() - 2);
        if (i < 0) return;
        const double s = place - static_cast<double>(i);
        for (long row = 0; row < curves.rows(); ++row)
            if (const double value = (1 - s) * curves(row, i) + s * curves(row, i + 1); value != 0)
                use(row, value);
    }

    Eigen::MatrixXd excitation_, channels_;  ///< one column for each 5 ms
    Eigen::MatrixXd bounded_;                ///< one row: 1 in a closure or a contact
    std::vector<int> mouth_;                 ///< columns of muscles that move the lips
    double excitation_start_s_, channels_start_s_;
};

WantedMouth wanted_at(const ArticulationCurves& curves, long i) {
    const auto value = [&](Parameter p) { return curves.values[static_cast<std::size_t>(p)][i]; };
    WantedMouth out;
    out.jaw = std::max(0.0, value(Parameter::kJaw));
    out.gap = value(Parameter::kGap);
    out.width = value(Parameter::kWidth);
    out.protrusion = value(Parameter::kProtrusion);
    out.labiodental = std::clamp(curves.labiodental[i], 0.0, 1.0);
    out.bounded = curves.bounded[i];
    return out;
}

/// How far the mouth has left its rest, [0, 1]: a face at rest needs no muscles.
double away_from_rest(const WantedMouth& wanted) {
    const double far =
        std::max({std::abs(wanted.jaw), std::abs(wanted.gap), std::abs(wanted.width) / 2,
                  std::abs(wanted.protrusion), 2 * wanted.labiodental});
    const double s = std::clamp((far - 0.05) / 0.6, 0.0, 1.0);
    return s * s * (3 - 2 * s);
}

/// Activations of all columns, one column of the matrix for each grid point.
Eigen::MatrixXd activations_of(const ArticulationCurves& curves, const RigVoice& voice, long rows) {
    Eigen::MatrixXd out = Eigen::MatrixXd::Zero(rows, curves.size());
    Eigen::VectorXd state;
    for (long i = 0; i < curves.size(); ++i) {
        const WantedMouth wanted = wanted_at(curves, i);
        const double away = away_from_rest(wanted);
        if (away == 0) continue;
        out.col(i) = away * voice.activation_for(wanted, state);
    }
    // Weights that come and go give small kinks: one smoothing over 15 ms.
    Eigen::MatrixXd smooth = out;
    for (long i = 1; i + 1 < out.cols(); ++i)
        smooth.col(i) = 0.25 * out.col(i - 1) + 0.5 * out.col(i) + 0.25 * out.col(i + 1);
    return smooth.cwiseMax(0.0).cwiseMin(1.0);
}

/// Excitations from which the activations follow, as far as muscles can.
Eigen::MatrixXd excitations_of(const Eigen::MatrixXd& activation, const rig::RigDescription& rig,
                               InversionReport* report) {
    const Eigen::VectorXd rise_s = rig.muscles.activation_s(),
                          fall_s = rig.muscles.deactivation_s();
    Eigen::MatrixXd out = activation;
    double squared = 0, max = 0;
    long cut = 0, active = 0;
    for (long m = 0; m < activation.rows(); ++m) {
        const muscle::ActivationTimes times{rise_s[m], fall_s[m]};
        double a = activation(m, 0);
        for (long i = 0; i < activation.cols(); ++i) {
            // From what the muscle has reached to where it is wanted one step later
            const double next = activation(m, std::min(i + 1, activation.cols() - 1));
            const double slope = (next - a) / kCurveStep_s, s = 0.5 + 1.5 * a;
            double u = a + slope * (slope > 0 ? times.t_act_s * s : times.t_deact_s / s);
            if (u < 0 || u > 1) ++cut;
            u = std::round(std::clamp(u, 0.0, 1.0) * kDigits) / kDigits;
            out(m, i) = u;
            if (a > 1e-3 || next > 1e-3) ++active;
            a = muscle::advance_activation(a, u, times, kCurveStep_s);
            squared += (a - next) * (a - next);
            max = std::max(max, std::abs(a - next));
        }
    }
    if (report) {
        report->rms = std::sqrt(squared / static_cast<double>(std::max(1L, active)));
        report->max = max;
        report->cut_fraction = static_cast<double>(cut) / static_cast<double>(std::max(1L, active));
    }
    return out;
}

}  // namespace

std::shared_ptr<const track::DriveSource> drive_of(const ArticulationCurves& curves,
                                                   const RigVoice& voice,
                                                   const rig::RigDescription& rig, double start_s,
                                                   InversionReport* report) {
    const long rows = rig.channels().column_count();
    Eigen::MatrixXd excitation = excitations_of(activations_of(curves, voice, rows), rig, report);
    Eigen::MatrixXd channels(5, curves.size());
    for (long i = 0; i < curves.size(); ++i) {
        const auto value = [&](Parameter p) {
            return curves.values[static_cast<std::size_t>(p)][i];
        };
        const auto rounded = [](double x) { return std::round(x * kDigits) / kDigits; };
        channels(0, i) = rounded(voice.jaw_open_of(std::max(0.0, value(Parameter::kJaw))));
        channels(1, i) = rounded(std::clamp(
            kTongueUp * (value(Parameter::kTipHeight) - kRestTip) / (1 - kRestTip), -1.0, 1.0));
        // Only what goes out between the teeth; the tip at the ridge is the channel above.
        channels(2, i) = rounded(std::clamp(
            (value(Parameter::kTipForward) - 2) / rig.facs.ranges.tongue_out_mm, 0.0, 1.0));
        const auto body = [&](Parameter p, double most) {
            return rounded(std::clamp((value(p) - kRestBody) / (most - kRestBody), -1.0, 1.0));
        };
        channels(3, i) = body(Parameter::kBodyHeight, speech::kPressedBody);
        channels(4, i) = body(Parameter::kBodyBack, kBackmost);
    }
    const double begin_s = start_s + curves.start_s;
    std::vector<int> mouth;
    const track::ChannelTable muscles = rig.channels();
    for (const char* muscle : kLipMuscles)
        if (muscles.find(muscle))
            for (const Side side : {Side::kLeft, Side::kRight})
                if (const int column = muscles.column(muscle, side);
                    mouth.empty() || mouth.back() != column)
                    mouth.push_back(column);
    return std::make_shared<SpeechDrive>(std::move(excitation), begin_s - kTissueLead_s,
                                         std::move(channels), begin_s, ramped(curves.bounded),
                                         std::move(mouth));
}

}  // namespace risorius::talk
