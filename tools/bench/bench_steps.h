// SPDX-License-Identifier: MIT
/// \file
/// Benchmark of time and error of the steps of a face on a demanding track: smile, sneer, open jaw and pucker alternate every
/// half second, the jaw opens twice a second, and the eyes blink.
///
///   error   of skin nodes over all steps, relative to the same track with every step converged; accumulated errors are included
///   time    CPU time of one core for a step of 1/60 s: median and mean over the steps of three runs; and the median over
///           steps of the minimum of the three runs, which depends least on the load of the machine
#pragma once

#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/core/progress_monitor.h"
#include "risorius/face/face.h"
#include "risorius/scene/rig_files.h"
#include "risorius/track/script.h"

namespace risorius::bench {

inline constexpr double kStepTrack_s = 4.0;

/// The track, for a rig with the standard action units.
track::ScriptDescription step_track(const scene::RigFiles& files);

/// "preview" on a shell of another size. Finer shells reach the same error with one iteration less.
face::Quality preview_with(int skin_vertices);

struct StepBench {
    face::Quality quality;
    int steps = 240;  ///< number of steps from the start of the track
};

/// Returns for each entry: quality, nodes, tets, max_inverted_tets (over all steps), steps, iterations (mean), step_ms,
/// least_step_ms and mean_step_ms, rms_mm and largest_mm. Entries with equal shells and steps share the converged track.
Json bench_steps(const scene::RigFiles& files, const std::vector<StepBench>& cases,
                 const ProgressMonitor& monitor = {});

/// The qualities of face::quality_named(), followed by shells of about 10 and 20 thousand nodes with the iterations of "fine",
/// for the first second.
std::vector<StepBench> usual_step_benches();

}  // namespace risorius::bench
