// SPDX-License-Identifier: MIT
#include "risorius/face/solver/stress.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "risorius/core/counter_rng.h"
#include "risorius/face/diagnostics.h"

namespace risorius::face {

namespace {

constexpr double kHold_s = 0.2;   // time between two draws of active muscles
constexpr double kSwing_s = 0.5;  // time between two targets of jaw and head

struct Goal {
    track::Kinematic channel;
    double min, max;
};
// Head shakes, nods, chewing and gaze shifts at natural speeds
constexpr Goal kGoals[] = {
    {track::Kinematic::kJawOpen, -0.4, 0.8},       {track::Kinematic::kJawForward, -0.5, 0.8},
    {track::Kinematic::kJawSide, -0.7, 0.7},       {track::Kinematic::kHeadYaw, -30, 30},
    {track::Kinematic::kHeadPitch, -20, 20},       {track::Kinematic::kHeadRoll, -15, 15},
    {track::Kinematic::kHeadUp, -30, 30},          {track::Kinematic::kHeadForward, -30, 30},
    {track::Kinematic::kGazeYawLeft, -30, 30},     {track::Kinematic::kGazeYawRight, -30, 30},
    {track::Kinematic::kGazePitchLeft, -20, 20},   {track::Kinematic::kGazePitchRight, -20, 20},
    {track::Kinematic::kMouthPressure, -500, 1500}};

// Returns a random number that depends only on its key, not on the order of calls
double chance(int seed, unsigned stream, long row, long column) {
    return CounterRng()
        .at(static_cast<std::uint64_t>(seed))
        .at(stream)
        .at(static_cast<std::uint64_t>(row))
        .at(static_cast<std::uint64_t>(column))
        .uniform_open();
}

// Returns the quantile of the values for this fraction; 0 if there are none.
double fraction_below(std::vector<double> values, double fraction) {
    if (values.empty()) return 0;
    std::sort(values.begin(), values.end());
    const auto at =
        static_cast<std::size_t>(std::ceil(fraction * static_cast<double>(values.size())));
    return values[std::max<std::size_t>(at, 1) - 1];
}

}  // namespace

DriveAt stress_drive(const track::ChannelTable& channels, const StressOptions& options,
                     double end_s) {
    return [columns = channels.column_count(), min = channels.column_min(), options,
            end_s](double t_s) {
        track::Drive drive;
        drive.excitation = Eigen::VectorXd::Zero(columns);
        if (t_s >= end_s) return drive;
        const long hold = static_cast<long>(t_s / kHold_s);
        for (long c = 0; c < columns; ++c)
            if (chance(options.seed, 1, hold, c) < options.active_fraction)
                drive.excitation[c] = min[c] + (1 - min[c]) * chance(options.seed, 2, hold, c);
        const long swing = static_cast<long>(t_s / kSwing_s);
        const double place = t_s / kSwing_s - static_cast<double>(swing);
        const double fraction = 0.5 * (1 - std::cos(std::numbers::pi * place));
        long column = 0;
        for (const Goal& goal : kGoals) {
            // The motion starts and ends at rest
            const auto value = [&](long at) {
                if (at == 0 || static_cast<double>(at) * kSwing_s > end_s - kSwing_s) return 0.0;
                const double x =
                    goal.min + (goal.max - goal.min) * chance(options.seed, 3, at, column);
                const bool within = goal.channel == track::Kinematic::kJawOpen ||
                                    goal.channel == track::Kinematic::kJawForward;
                return within ? std::max(0.0, x) : x;
            };
            drive.kinematic[static_cast<std::size_t>(goal.channel)] =
                (1 - fraction) * value(swing) + fraction * value(swing + 1);
            ++column;
        }
        return drive;
    };
}

StressReport stress(Face& face, const track::ChannelTable& channels, const StressOptions& options) {
    StressReport report;
    const DriveAt drive = stress_drive(channels, options, options.steps * face.step_s());
    face.start([&](double) {
        track::Drive rest;
        rest.excitation = Eigen::VectorXd::Zero(channels.column_count());
        return rest;
    });
    const Points rest = face.diagnostics().skin_nodes();
    int in_a_row = 0;
    std::vector<double> lips_m, bone_m, eyeball_m;
    for (report.steps = 0; report.steps < options.steps; ++report.steps) {
        face.step(drive);
        const Points now = face.diagnostics().skin_nodes();
        if (!now.allFinite()) {
            ++report.broken_steps;
            break;  // later states would be meaningless
        }
        const int inverted = face.diagnostics().inverted_tets();
        in_a_row = inverted > 0 ? in_a_row + 1 : 0;
        report.max_inverted_tets = std::max(report.max_inverted_tets, inverted);
        report.longest_inverted_steps = std::max(report.longest_inverted_steps, in_a_row);
        report.mean_inverted_tets += static_cast<double>(inverted) / options.steps;
        report.furthest_m = std::max(report.furthest_m, (now - rest).rowwise().norm().maxCoeff());
        const Penetration penetration = face.diagnostics().penetration();
        lips_m.push_back(penetration.lips_m);
        bone_m.push_back(penetration.bone_m);
        eyeball_m.push_back(penetration.eyeball_m);
    }
    report.usual_penetration = {fraction_below(lips_m, 0.99), fraction_below(bone_m, 0.99),
                                fraction_below(eyeball_m, 0.99)};
    report.deepest_penetration = {fraction_below(lips_m, 1), fraction_below(bone_m, 1),
                                  fraction_below(eyeball_m, 1)};
    for (int step = 0; step < options.rest_steps; ++step) face.step(drive);
    report.inverted_at_rest = face.diagnostics().inverted_tets();
    report.residual_displacement_m =
        (face.diagnostics().skin_nodes() - rest).rowwise().norm().maxCoeff();
    return report;
}

}  // namespace risorius::face
