// SPDX-License-Identifier: MIT
/// \file
/// Makes all clips of a design, in one run or in several. Clips that are there and have not changed are kept, and a clip that fails
/// does not stop the others. A complete set also gets the files that a laboratory needs: see stimulus_set.h.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/core/progress_monitor.h"
#include "risorius/stimuli/detail/clip.h"

namespace risorius::stimuli {

struct BatchOptions {
    std::filesystem::path design, out;
    int workers = 2;  ///< clips made at once
    int part = 1,
        parts = 1;  ///< on several machines: which part of the clips this one makes, from 1
    /// Called when a clip is "kept", "filmed" (rendered, to be matched in luminance later), "made" or "failed"; `why` is empty
    /// unless it failed. Calls come from several threads, one at a time.
    std::function<void(const std::string& clip, const std::string& state, const std::string& why)>
        report_clip{};
};

struct BatchPlan {
    std::string name;
    design::Match match;
    std::optional<design::ExperimentOptions> experiment;
    /// By the name of the set: how balanced it is, for sets that are only a part of their crossing.
    std::vector<std::pair<std::string, design::Balance>> balances;
    std::vector<ClipPlan> clips;
    std::vector<std::string> notes;                 ///< what can be rendered, but may be a mistake
    std::shared_ptr<animate::RenderInputs> inputs;  ///< rigs that are read, for all clips
    double seconds() const;    ///< estimated time to make all clips, on two cores
    double megabytes() const;  ///< estimated
};

/// Reads the design, crosses its factors and checks every clip. Renders nothing. Throws Error.
BatchPlan plan_batch(const std::filesystem::path& design);

/// Throws Error unless the folder is new, empty or one that a batch has begun.
void check_batch_folder(const std::filesystem::path& out);

struct BatchReport {
    std::string name;
    int made = 0, kept = 0;
    int elsewhere = 0;  ///< clips that belong to other parts
    int unmeasured =
        0;  ///< conditions of other parts that must be rendered before luminance can be matched
    std::vector<std::pair<std::string, std::string>> failed;  ///< the clip, and why
    bool complete = false;  ///< all clips and the files of the set are there
    double seconds = 0;
    Json json() const;
};

/// Throws Error before anything is made when the design or the folder is wrong, and Interrupted when the monitor asks to stop.
BatchReport make_batch(const BatchOptions& options, const ProgressMonitor& monitor = {});

}  // namespace risorius::stimuli
