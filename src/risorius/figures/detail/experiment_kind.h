// SPDX-License-Identifier: MIT
/// \file
/// What every kind of experiment is to the registry: a function from the experiment file to tables, charts, shapes and
/// measurements. To add one: write such a function, list it in registry.cpp and make a folder in samples/figures.
#pragma once

#include <functional>
#include <string_view>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/figures/detail/figure_result.h"
#include "risorius/figures/detail/measurements.h"
#include "risorius/figures/detail/run_options.h"

namespace risorius::figures {

struct Outcome {
    FigureResult figure;    ///< id, title and checks are filled in by the registry
    Measurements measured;  ///< what the file's checks may name
};

using RunExperiment = void (*)(const JsonCursor& experiment, const RunOptions& options,
                               Outcome& outcome);

/// JsonCursor::allow_keys with the keys every experiment file may have (format, version, figure, kind, title, checks).
void allow_experiment_keys(const JsonCursor& experiment, std::vector<std::string_view> own);

}  // namespace risorius::figures
