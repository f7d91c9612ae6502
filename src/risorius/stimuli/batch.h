// All clips of a design, made in one go or in several: what is there already and has not changed is kept, what fails does not
// stop the others. Beside the clips come what a laboratory needs of the set: see stimulus_set.h.
#pragma once

#include <filesystem>
#include <functional>
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
        parts = 1;  ///< of several machines: which share of the clips is made here, from 1
    /// Of each clip as it is kept, filmed (when luminance is matched), made or failed; `why` is empty unless it failed. From several threads, one at a time.
    std::function<void(const std::string& clip, const std::string& state, const std::string& why)>
        told{};
};

struct BatchPlan {
    std::string name;
    design::Match match;
    std::optional<design::ExperimentOptions> experiment;
    std::vector<std::pair<std::string, design::Balance>>
        balances;  ///< of the sets that are only a part of their crossing
    std::vector<ClipPlan> clips;
    std::vector<std::string> notes;  ///< what can be rendered, but may not be meant
    double seconds() const;          ///< to make all of them, about, on two cores
    double megabytes() const;
};

/// Reads, crosses and checks the whole design; renders nothing. Throws Error.
BatchPlan plan_batch(const std::filesystem::path& design);

/// A folder of somebody else is not filled with clips. Throws Error.
void check_batch_folder(const std::filesystem::path& out);

struct BatchReport {
    std::string name;
    int made = 0, kept = 0, elsewhere = 0;  ///< of another part
    int unmeasured = 0;  ///< conditions of other parts without which luminance cannot be matched
    std::vector<std::pair<std::string, std::string>> failed;  ///< clip and why
    bool complete = false;  ///< all clips are there, and the set's files
    double seconds = 0;
    Json json() const;
};

/// Throws Error before anything is made when the design or the folder is wrong; Interrupted when asked to stop.
BatchReport make_batch(const BatchOptions& options, const ProgressMonitor& monitor = {});

}  // namespace risorius::stimuli
