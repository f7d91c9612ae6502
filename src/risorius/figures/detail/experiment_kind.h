// SPDX-License-Identifier: MIT
/// \file
/// The interface of a kind of experiment: a function that reads the experiment file and returns tables, charts, shapes and
/// measurements. To add a kind, write such a function, list it in registry.cpp and add a folder to samples/figures.
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

/// Calls JsonCursor::allow_keys() with the keys `own` of a kind and those that every experiment file may have (format, version,
/// figure, kind, title, checks, claims, watched).
void allow_experiment_keys(const JsonCursor& experiment, std::vector<std::string_view> own);

}  // namespace risorius::figures
