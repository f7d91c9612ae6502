// SPDX-License-Identifier: MIT
/// \file
/// A stress test: a long run with random excitation and random motion of jaw and head. It measures whether the face stays intact and
/// returns to rest.
#pragma once

#include "risorius/face/face.h"
#include "risorius/track/channels.h"

namespace risorius::face {

struct StressOptions {
    int steps = 10000;
    int seed = 1;
    double active_fraction = 0.35;  ///< fraction of muscles that are active; drawn every 0.2 s
    int rest_steps = 300;           ///< steps without drive after the run
};

struct StressReport {
    int steps = 0;
    int broken_steps = 0;            ///< steps with a position that is not finite
    int max_inverted_tets = 0;       ///< maximum over the steps
    int longest_inverted_steps = 0;  ///< longest run of steps with inverted tetrahedra
    double mean_inverted_tets = 0;   ///< mean over the steps
    double furthest_m = 0;           ///< maximum displacement of a skin node from rest
    /// Of the surfaces shown after each step: 99th percentile and maximum over the steps.
    Penetration usual_penetration, deepest_penetration;
    int inverted_at_rest = 0;            ///< inverted tetrahedra after the rest steps
    double residual_displacement_m = 0;  ///< maximum distance of a skin node from its start
};

/// Returns the drive of a stress run. It is that of rest from `end_s` on.
DriveAt stress_drive(const track::ChannelTable& channels, const StressOptions& options,
                     double end_s);

/// Starts the face, runs it, and lets it come to rest.
StressReport stress(Face& face, const track::ChannelTable& channels, const StressOptions& options);

}  // namespace risorius::face
