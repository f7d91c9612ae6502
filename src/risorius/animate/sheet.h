// SPDX-License-Identifier: MIT
/// \file
/// Frames of scripts side by side in one picture: one row per script and head, one column per time.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "risorius/animate/render_request.h"
#include "risorius/core/json_cursor.h"
#include "risorius/core/progress_monitor.h"

namespace risorius::animate {

/// Options of make_sheet().
struct SheetOptions {
    std::vector<std::filesystem::path> scripts;  ///< at least one
    std::vector<std::filesystem::path> rigs;     ///< empty: each script with its own rig
    std::vector<double> times_s;                 ///< at least one, in the order of the columns
    /// Names of cameras; each time is shown from each of them. Empty: the camera of `view`
    std::vector<std::string> cameras;
    /// Headings of the columns, one for each. Empty: the times, and the names of the cameras
    std::vector<std::string> captions;
    /// .png files to compare with, in rows of their own
    std::vector<std::filesystem::path> beside;
    std::filesystem::path out;  ///< .png
    RenderRequest view;         ///< only size, camera, show, quality and threads are used
};

/// Writes OUT and OUT.json with the records of all runs. Throws Error, RunError and Interrupted.
Json make_sheet(const SheetOptions& options, const ProgressMonitor& monitor = {});

}  // namespace risorius::animate
