// SPDX-License-Identifier: MIT
/// \file
/// A kind of experiment, as the registry sees it: a function from the experiment file to tables, charts, shapes and measurements.
/// To add a kind, write such a function, list it in registry.cpp and add a folder to samples/figures.
#pragma once

#include <functional>
#include <string_view>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/figures/detail/figure_result.h"
#include "risorius/figures/detail/measurements.h"
#include "risorius/figures/detail/run_options.h"

namespace risorius::figures {

/// What a kind of experiment returns.
struct Outcome {
    FigureResult figure;    ///< the registry fills in id, title and checks
    Measurements measured;  ///< values that the checks of the file may name
};

using RunExperiment = void (*)(const JsonCursor& experiment, const RunOptions& options,
                               Outcome& outcome);

/// JsonCursor::allow_keys() with `own` and the keys that every experiment file may have (format, version, figure, kind, title,
/// checks).
void allow_experiment_keys(const JsonCursor& experiment, std::vector<std::string_view> own);

}  // namespace risorius::figures
