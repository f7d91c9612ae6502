// Moments of scripts on one picture: a row per script and head, a column per time.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "risorius/animate/animate.h"

namespace risorius::animate {

struct SheetOptions {
    std::vector<std::filesystem::path> scripts;  ///< at least one
    std::vector<std::filesystem::path> rigs;     ///< none: each script's own
    std::vector<double> times_s;                 ///< at least one, in the order of the columns
    std::vector<std::string>
        cameras;  ///< none: that of the view; else columns for each, by all times
    std::vector<std::filesystem::path>
        beside;                 ///< pictures (.png) to compare with, in a row of their own
    std::filesystem::path out;  ///< .png
    AnimateOptions view;        ///< size, camera, show, quality and threads of it count
};

/// Writes OUT and OUT.json, the records of all runs. Throws Error, RunError, Interrupted.
Json make_sheet(const SheetOptions& options, const ProgressMonitor& monitor = {});

}  // namespace risorius::animate
