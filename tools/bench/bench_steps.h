// How fast and how true the steps of a face are, on a track that is hard to follow: smile, sneer, open jaw and pucker in turn
// every half second, the jaw swinging twice a second, blinks.
//
//   error   of skin nodes over all steps, against the same track with every step converged: lag that adds up counts in full
//   time    processor time of one core per step of 1/60 s: median and mean over the steps of three runs, and the median of
//           what each step takes at least in one of the three, which is the program's own where others share the machine
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

struct StepBench {
    face::Quality quality;
    int steps = 240;  ///< of the track, from its start
};

/// Per entry: quality, nodes, tets, most_inverted_tets (of any step), steps, iterations (mean), step_ms, least_step_ms and mean_step_ms, rms_mm and
/// largest_mm. Entries with equal shells and steps share the converged track.
Json bench_steps(const scene::RigFiles& files, const std::vector<StepBench>& cases,
                 const ProgressMonitor& monitor = {});

/// The qualities to choose from, then shells of about 10 and 20 thousand nodes at the iterations of "fine" for the first
/// second.
std::vector<StepBench> usual_step_benches();

}  // namespace risorius::bench
