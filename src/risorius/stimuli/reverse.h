// SPDX-License-Identifier: MIT
/// \file
/// Reverse correlation: from answers to random facial movements to the expression that an observer has in mind.
///
///   model.tsv, model.json     for each answer and unit: correlation, weight, role and course, with intervals
///   model_ANSWER.json         the resulting expression, a script; _low and _high: the ends of the interval of its amplitudes
///   model_ANSWER.mp4, .png    the expression as a video, and as a strip of pictures with both ends of the interval
///   index.html                all of it as a page
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/core/progress_monitor.h"
#include "risorius/stimuli/detail/classification.h"

namespace risorius::stimuli {

/// Options of reverse_correlation().
struct ReverseOptions {
    std::filesystem::path table;  ///< sample.tsv of a set
    /// Tables of answers, with or without a column of participants
    std::vector<std::filesystem::path> responses;
    std::filesystem::path out, rig;
    std::vector<std::string> answers;  ///< those that get a model; empty: all that were given
    bool pictures = true;              ///< whether the expressions are also rendered
    bool by_participant = false;  ///< whether it is told in how many participants a unit is found
    ClassificationOptions classification;
};

/// Reads a sample and the answers to it. Rows without an answer are left out. Throws Error.
Observations read_observations(const ReverseOptions& options);

/// Writes the models, and returns what model.json holds. Throws Error.
Json reverse_correlation(const ReverseOptions& options, const ProgressMonitor& monitor = {});

}  // namespace risorius::stimuli
