// SPDX-License-Identifier: MIT
/// \file
/// A face driven at random: what a long run of wild excitation, jaw and head does to it, and whether it comes back.
#pragma once

#include "risorius/face/face.h"
#include "risorius/track/channels.h"

namespace risorius::face {

struct StressOptions {
    int steps = 10000;
    int seed = 1;
    double active_fraction =
        0.35;              ///< of the muscles, at random strength, anew every fifth of a second
    int rest_steps = 300;  ///< of rest afterwards
};

struct StressReport {
    int steps = 0;
    int broken_steps = 0;            ///< with a position that is not finite
    int max_inverted_tets = 0;       ///< at once
    int longest_inverted_steps = 0;  ///< in a row with any
    double mean_inverted_tets = 0;
    double furthest_m = 0;  ///< of a skin node from rest
    /// Of what is shown after every step: what 99 of 100 steps stay below, and the deepest.
    Penetration usual_penetration, deepest_penetration;
    int inverted_at_rest = 0;            ///< after the rest
    double residual_displacement_m = 0;  ///< furthest skin node from where it began
};

/// The drive of a stress run at any time; rest from `end_s` on.
DriveAt stress_drive(const track::ChannelTable& channels, const StressOptions& options,
                     double end_s);

StressReport stress(Face& face, const track::ChannelTable& channels, const StressOptions& options);

}  // namespace risorius::face
