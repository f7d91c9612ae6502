// SPDX-License-Identifier: MIT
/// \file
/// Runs experiments of samples/figures, or of the user's own file, and writes folders of results:
///
///   DIR/results.json     id, checks, parameters, what was run, the list of all files
///   DIR/experiment.json  the input
///   DIR/index.html       published and measured values side by side
///   DIR/*.csv *.svg *.png *.gp
///   DIR/timing.json      run time: the only file that differs between two runs
///
/// When several figures are run, each has such a folder below DIR, and DIR itself has a page that shows all of them.
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/core/progress_monitor.h"
#include "risorius/figures/detail/figure_result.h"
#include "risorius/figures/detail/run_options.h"
#include "risorius/plot/write_chart.h"

namespace risorius::figures {

using FigureRunner = std::function<figures::FigureResult(const JsonCursor& experiment,
                                                         const figures::RunOptions& options)>;

/// Options of run_figures().
struct FigureOptions {
    std::string figure;  ///< an id, several ("8a,8b"), "all", or the path of an experiment.json
    /// A folder that is new, empty or has former results, which are replaced
    std::filesystem::path out;
    /// Folder with one folder per id; empty: samples/figures of this toolkit
    std::filesystem::path from;
    int threads = 0;  ///< 0: as many as the machine has; results do not depend on it
    plot::ChartWriter charts{};
    FigureRunner run{};  ///< empty: figures::run_figure()
};

/// A measured value outside its accepted range, or a verdict that what was measured contradicts.
struct FailedCheck {
    std::string figure;
    std::string what;  ///< "peak: expected 8 to 13 %, found 14 %"
};

struct FigureReport {
    Json results;  ///< the content of results.json in `out`
    std::vector<FailedCheck> failed;
};

/// Runs figures and writes the folder `out` completely or not at all. A value outside its range is not an error; it is listed in
/// FigureReport::failed. Throws Error for an unknown figure, a wrong experiment or an `out` that cannot be used, RunError when
/// writing or drawing fails, Interrupted when the monitor asks to stop.
FigureReport run_figures(const FigureOptions& options, const ProgressMonitor& monitor = {});

struct FigureEntry {
    std::string id, title;
    double run_time_s = 0;  ///< approximate; 0 when unknown
};

/// Lists every folder of `from` with an experiment.json, those of the thesis first and in its order. Throws Error when there is
/// none.
std::vector<FigureEntry> list_figures(const std::filesystem::path& from = {});

}  // namespace risorius::figures
