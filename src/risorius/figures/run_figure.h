// SPDX-License-Identifier: MIT
/// \file
/// Runs experiments of samples/figures, or of a file of one's own, and writes what they leave as folders of results:
///
///   DIR/results.json     id, checks, parameters, what was run, the list of all files
///   DIR/experiment.json  what it was run from
///   DIR/index.html       published and measured side by side
///   DIR/*.csv *.svg *.png *.gp
///   DIR/timing.json      how long it took: the only file that differs between two runs
///
/// Of several figures each has such a folder below DIR, and DIR the page of all.
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

struct FigureOptions {
    std::string figure;  ///< an id, several ("8a,8b"), "all", or the path of an experiment.json
    std::filesystem::path out;  ///< a folder, new, empty or with former results, which are replaced
    std::filesystem::path
        from;         ///< where the ids are folders; empty: samples/figures of this toolkit
    int threads = 0;  ///< 0 = as many as the machine has; results do not depend on it
    plot::ChartWriter charts{};
    FigureRunner run{};  ///< empty: figures::run_figure
};

/// A number outside of its accepted range.
struct FailedCheck {
    std::string figure;
    figures::Check check;
};

struct FigureReport {
    Json results;  ///< the results.json of `out`
    std::vector<FailedCheck> failed;
};

/// All of `out` is written or nothing. Numbers outside of their ranges are a result, not an error. Throws Error for an
/// unknown figure, a wrong experiment or an `out` that cannot be used, RunError when writing or drawing fails,
/// Interrupted when asked to stop.
FigureReport run_figures(const FigureOptions& options, const ProgressMonitor& monitor = {});

struct FigureEntry {
    std::string id, title;
    double run_time_s = 0;  ///< about; 0 when it is not known
};

/// Every folder of `from` with an experiment.json, those of the thesis first and in its order. Throws Error when there
/// is none.
std::vector<FigureEntry> list_figures(const std::filesystem::path& from = {});

}  // namespace risorius::figures
