// SPDX-License-Identifier: MIT
/// \file
/// A stress test: a long run with random excitations and random motion of jaw, head and eyes. It measures whether the face stays intact
/// and returns to rest.
#pragma once

#include "risorius/face/face.h"
#include "risorius/track/channels.h"

namespace risorius::face {

/// Options of a stress run.
struct StressOptions {
    int steps = 10000;              ///< steps with drive
    int seed = 1;                   ///< of the random drive
    double active_fraction = 0.35;  ///< mean fraction of active muscles, drawn anew every 0.2 s
    int rest_steps = 300;           ///< steps without drive after the run
};

/// Results of a stress run.
struct StressReport {
    int steps = 0;         ///< steps made with drive
    int broken_steps = 0;  ///< 1 if a position became NaN or infinite, which ends the run; else 0
    int max_inverted_tets = 0;       ///< maximum of inverted tetrahedra over the steps
    int longest_inverted_steps = 0;  ///< longest run of steps with inverted tetrahedra
    double mean_inverted_tets = 0;   ///< mean of inverted tetrahedra over the steps
    double furthest_m = 0;           ///< maximum displacement of a skin node from rest
    /// 99th percentile and maximum, over the steps, of the penetration of the surfaces that are shown.
    Penetration usual_penetration, deepest_penetration;
    int inverted_at_rest = 0;            ///< inverted tetrahedra after the rest steps
    double residual_displacement_m = 0;  ///< the same as furthest_m, after the rest steps
};

/// Returns the drive of a stress run. From the time `end_s`, s, on nothing is driven.
DriveAt stress_drive(const track::ChannelTable& channels, const StressOptions& options,
                     double end_s);

/// Starts the face, makes the steps with drive, then the rest steps, and returns the report.
StressReport stress(Face& face, const track::ChannelTable& channels, const StressOptions& options);

}  // namespace risorius::face
