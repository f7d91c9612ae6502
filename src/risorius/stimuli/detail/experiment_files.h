// SPDX-License-Identifier: MIT
/// \file
/// An example experiment for a set of clips: the clips are shown in random order, and the participant answers a question by
/// pressing a key.
///
///   experiment/conditions.csv    a row for each clip: file, frames, fps, the right key, values
///   experiment/settings.json     question, keys, times
///   experiment/experiment.py     for PsychoPy
///   experiment/index.html        for jsPsych, in a browser
///   experiment/rating.html       for raters, in a browser: their judgements are the norms of the set
#pragma once

#include <map>
#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/stimuli/batch.h"
#include "risorius/stimuli/detail/write_below.h"

namespace risorius::stimuli {

/// Checks that the design has everything that its experiment names, and adds notes to the plan. Throws Error.
void check_experiment(BatchPlan& plan);

/// Writes the files. All clips must exist.
void write_experiment(const BatchPlan& plan, const std::vector<Json>& records,
                      const WriteFile& write_below);

/// The right answer of each clip that has one, in the words of the experiment.
std::map<std::string, std::string> right_answers(const BatchPlan& plan);

}  // namespace risorius::stimuli
