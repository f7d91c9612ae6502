// SPDX-License-Identifier: MIT
/// \file
/// The figures of the thesis, and the kinds of experiment that make them. In this folder, "the thesis" is M. Dobsik, Computer
/// Animation of Soft Tissues, Brno 2005. An experiment file says what is run, what is measured and what was published. Users can
/// run files of their own in the same way:
///
///   {"format": "risorius-experiment", "version": 1, "figure": "9b", "kind": "volume-history", "title": "...", ...}
///
/// "figure" is the id of the results and "kind" selects the experiment. The header of each kind documents its further keys.
#pragma once

#include <string_view>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/figures/detail/figure_result.h"
#include "risorius/figures/detail/run_options.h"

namespace risorius::figures {

/// Where a figure comes from. kThesis: it is a figure of the thesis. kBeyond: it comes with the program, but is not in the
/// thesis. kOwn: it comes from a user's file.
enum class Origin { kThesis, kBeyond, kOwn };

/// A figure that comes with the program, in samples/figures/ID/experiment.json.
struct Figure {
    std::string_view id;     ///< "9b"
    std::string_view title;  ///< one line that says what it shows
    std::string_view kind;   ///< kind of experiment
    double run_time_s;       ///< approximate wall time on two cores
    Origin origin = Origin::kThesis;
};

/// All figures, in the order of the thesis, followed by those beyond it.
const std::vector<Figure>& figures();

Origin origin_of(std::string_view id);

/// The valid values of "kind".
std::vector<std::string_view> kinds();

/// Runs an experiment. `experiment`: root of an experiment file. Throws Error for a wrong file, Interrupted when the monitor asks
/// to stop.
FigureResult run_figure(const JsonCursor& experiment, const RunOptions& options = {});

/// Reads the whole file and builds its bodies without running anything. Throws Error for a wrong file.
void check_experiment(const JsonCursor& experiment);

}  // namespace risorius::figures
