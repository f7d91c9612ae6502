// SPDX-License-Identifier: MIT
/// \file
/// The thesis' figures and the kinds of experiment that make them. An experiment file says what is run, what is measured
/// and what was published; so a person's own parameters run just as well:
///
///   {"format": "risorius-experiment", "version": 1, "figure": "9b", "kind": "volume-history", "title": "...", ...}
///
/// "figure" names the results, "kind" chooses the experiment; each kind lists its further keys in its own header.
#pragma once

#include <string_view>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/figures/detail/figure_result.h"
#include "risorius/figures/detail/run_options.h"

namespace risorius::figures {

enum class Origin { kThesis, kBeyond, kOwn };  ///< kOwn: none that comes with the program

/// A figure that comes with the program: samples/figures/ID/experiment.json.
struct Figure {
    std::string_view id;     ///< "9b"
    std::string_view title;  ///< one line, what it shows
    std::string_view kind;   ///< of experiment
    double run_time_s;       ///< about, on two cores
    Origin origin = Origin::kThesis;
};

/// In the order of the thesis, then those that go beyond it.
const std::vector<Figure>& figures();

Origin origin_of(std::string_view id);

/// The names "kind" may have.
std::vector<std::string_view> kinds();

/// `experiment` is the top of an experiment file. Throws Error for a wrong file, Interrupted when asked to stop.
FigureResult run_figure(const JsonCursor& experiment, const RunOptions& options = {});

/// Reads the whole file and builds its bodies, but runs nothing of it. Throws Error for a wrong one.
void check_experiment(const JsonCursor& experiment);

}  // namespace risorius::figures
