// SPDX-License-Identifier: MIT
/// \file
/// Makes all clips of a design, in one run or in several. Existing clips that have not changed are kept. A clip that fails does
/// not stop the others. A complete set also gets the files that a laboratory needs: see stimulus_set.h.
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
#include "risorius/stimuli/detail/trigger_codes.h"

namespace risorius::stimuli {

/// Options of make_batch().
struct BatchOptions {
    std::filesystem::path design, out;
    int workers = 2;  ///< number of clips that are made at the same time
    /// Ratings of the clips, see norms.h; empty: those that the set has already
    std::filesystem::path norms = {};
    bool replace = false;  ///< whether files that were changed since they were made are replaced
    /// When several machines make the set: the number of the part of the clips that this one makes, from 1, and the number of
    /// parts
    int part = 1, parts = 1;
    /// Called when a clip is "kept", "filmed" (rendered, to be matched in luminance later), "made" or "failed"; `why` is empty
    /// unless it failed. Calls come from several threads, one at a time.
    std::function<void(const std::string& clip, const std::string& state, const std::string& why)>
        report_clip{};
};

/// A design that has been read and checked.
struct BatchPlan {
    std::string name;
    std::filesystem::path design;  ///< its file
    /// What was drawn at random for reverse correlation, by set
    std::vector<std::pair<std::string, design::SampleBalance>> samples;
    design::Match match;
    std::optional<design::ExperimentOptions> experiment;
    design::TriggerOptions triggers;
    CodesOfClips codes;
    design::DatasetOptions dataset;
    /// For each set of conditions that uses only a part of its crossing: how balanced that part is (design/detail/crossing.h). The key
    /// is its name.
    std::vector<std::pair<std::string, design::Balance>> balances;
    std::vector<ClipPlan> clips;
    /// Problems that do not prevent rendering, but may be mistakes
    std::vector<std::string> notes;
    /// Rigs that have been read, shared by all clips
    std::shared_ptr<animate::RenderInputs> inputs;
    double seconds() const;    ///< estimated time to make all clips on two cores
    double megabytes() const;  ///< estimated
    /// Names a key of the design in messages: "mine/design.json:/experiment/over".
    std::string place(const std::string& key) const { return design.string() + ":/" + key; }
};

/// Returns the names of the clips, in the order of the plan.
std::vector<std::string> clip_names(const BatchPlan& plan);

/// Reads the design, crosses its factors and checks every clip. Renders nothing, but a design that matches motion is searched, which
/// takes some seconds for each condition when nothing is known from an earlier run. Only then the monitor is told. Throws Error for a
/// wrong design.
BatchPlan plan_batch(const std::filesystem::path& design, const ProgressMonitor& monitor = {});

/// The result of make_batch(): numbers of clips and conditions.
struct BatchReport {
    std::string name;
    int made = 0, kept = 0;
    int elsewhere = 0;  ///< clips that belong to other parts
    /// Conditions of other parts that must be rendered before luminance can be matched
    int unmeasured = 0;
    std::vector<std::pair<std::string, std::string>> failed;  ///< name of the clip and reason
    bool complete = false;           ///< all clips and the files of the set exist
    std::vector<std::string> notes;  ///< of the plan, and what came up while the clips were made
    /// Files of the set that somebody has changed. They stay, and the new ones are beside them, as NAME.new
    std::vector<std::string> changed;
    double seconds = 0;
    Json json() const;
};

/// Makes the clips. Throws Error before anything is made when the design or the folder is wrong, and Interrupted when the monitor
/// asks to stop.
BatchReport make_batch(const BatchOptions& options, const ProgressMonitor& monitor = {});

}  // namespace risorius::stimuli
