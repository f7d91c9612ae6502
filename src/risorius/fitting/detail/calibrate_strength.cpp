// SPDX-License-Identifier: MIT
#include "risorius/fitting/detail/calibrate_strength.h"

#include <algorithm>
#include <cmath>

#include "risorius/face/calibration.h"
#include "risorius/face/diagnostics.h"
#include "risorius/fitting/detail/fit_tolerance.h"

namespace risorius::fitting {

namespace {

constexpr double kWeakest = 0.1, kStrongest = 6.0;
constexpr double kTolerance = 0.01;  // of the stretch; the scatter of single fibres is larger
constexpr int kTrials = 6;
constexpr int kTrialIterations = 200;  // solver iterations per trial

// Secant steps in the logarithm of the strength, over which the stretch is nearly linear.
void calibrate(face::Face& face, const track::ChannelTable& channels, MuscleStrength& muscle) {
    track::Drive rest;
    rest.excitation = Eigen::VectorXd::Zero(channels.column_count());
    Eigen::VectorXd activation = rest.excitation;
    for (Side side : {Side::kLeft, Side::kRight})
        activation[channels.column(muscle.muscle, side)] = 1.0;
    face.start([&](double) { return rest; });

    const double of_the_rig = muscle.strength;
    double before_log = 0, before_miss = 0;
    double log_strength = std::log(muscle.strength);
    for (int trial = 0; trial < kTrials; ++trial) {
        muscle.strength = std::exp(log_strength);
        face.calibration().set_strength(muscle.muscle, muscle.strength / of_the_rig);
        muscle.converged = face.solve_equilibrium(activation, rest,
                                                  {.iterations = kTrialIterations,
                                                   .tolerance_m = kFitTolerance_m,
                                                   .planes_m = kFitTolerance_m})
                               .converged;
        muscle.stretch = face.diagnostics().mean_stretch(muscle.muscle);
        const double miss = muscle.stretch - muscle.target_stretch;
        if (std::abs(miss) < kTolerance) break;
        double step = miss > 0 ? 0.4 : -0.4;
        if (trial > 0 && std::abs(miss - before_miss) > 1e-6)
            step = -miss * (log_strength - before_log) / (miss - before_miss);
        before_log = log_strength;
        before_miss = miss;
        // The sign is enforced, because a stronger muscle always shortens more, whatever the last two trials suggest.
        step = std::clamp(miss > 0 ? std::abs(step) : -std::abs(step), -1.0, 1.0);
        const double next =
            std::clamp(log_strength + step, std::log(kWeakest), std::log(kStrongest));
        muscle.at_limit = next == log_strength;
        if (muscle.at_limit) break;
        log_strength = next;
    }
    face.calibration().set_strength(muscle.muscle, 1);
}

}  // namespace

std::vector<MuscleStrength> calibrate_strength(face::FaceTeam& team, const rig::RigDescription& rig,
                                               const ProgressMonitor& monitor) {
    std::vector<MuscleStrength> out;
    for (const rig::MuscleBand& band : rig.atlas.bands)
        if (out.empty() || out.back().muscle != band.muscle)
            out.push_back({.muscle = band.muscle,
                           .strength = rig.solid(band.muscle) != nullptr
                                           ? rig.solid(band.muscle)->strength
                                           : band.strength,
                           .target_stretch = band.shortens_to});
    const std::vector<MuscleStrength> of_the_rig = out;

    const track::ChannelTable channels = rig.channels();
    TaskProgress progress(monitor, static_cast<int>(out.size()));
    team.each(static_cast<int>(out.size()), [&](int m, face::Face& face) {
        MuscleStrength& muscle = out[static_cast<std::size_t>(m)];
        progress.begin(muscle.muscle);
        calibrate(face, channels, muscle);
    });
    track::Drive rest;
    rest.excitation = Eigen::VectorXd::Zero(channels.column_count());
    team.all([&](face::Face& face) {
        for (std::size_t m = 0; m < out.size(); ++m)
            face.calibration().set_strength(out[m].muscle,
                                            out[m].strength / of_the_rig[m].strength);
        face.start([&](double) { return rest; });
    });
    return out;
}

}  // namespace risorius::fitting
