// An example of an experiment with a set of clips: each is seen in an order drawn by chance, and a question is answered by a key.
//
//   experiment/conditions.csv    a row per clip: file, frames, fps, movement_onset_frame, apex_frame, the right key, values
//   experiment/settings.json     question, keys, times
//   experiment/experiment.py     for PsychoPy
//   experiment/index.html        for jsPsych, in a browser
#pragma once

#include <filesystem>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/stimuli/batch.h"

namespace risorius::stimuli {

/// What the design's experiment asks for must be there. Throws Error.
void check_experiment(BatchPlan& plan);

/// Of clips that are all made; the names of the files in `folder`.
std::vector<std::filesystem::path> write_experiment(const BatchPlan& plan,
                                                    const std::vector<Json>& records,
                                                    const std::filesystem::path& folder);

}  // namespace risorius::stimuli
