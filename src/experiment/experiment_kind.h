// What every kind of experiment is to the registry: a function from the experiment file to tables, charts, shapes and
// measurements. To add one: write such a function, list it in registry.cpp and make a folder in samples/figures.
#pragma once

#include <functional>
#include <string_view>
#include <vector>

#include "core/json_cursor.h"
#include "experiment/figure_result.h"
#include "experiment/measurements.h"
#include "experiment/run_options.h"

namespace risorius::experiment {

struct Outcome {
    FigureResult figure;    ///< id, title and checks are filled in by the registry
    Measurements measured;  ///< what the file's checks may name
};

using RunExperiment = void (*)(const JsonCursor& experiment, const RunOptions& options,
                               Outcome& outcome);

/// JsonCursor::allow_keys with the keys every experiment file may have (format, version, figure, kind, title, checks).
void allow_experiment_keys(const JsonCursor& experiment, std::vector<std::string_view> own);

/// Calls body(i) for i in [0, count) on several threads, lowest i first; each call must only write what is its own. The
/// first exception (by i) is thrown again after all have ended. Calls may nest when they share their spare threads.
void parallel_for(int count, const ThreadLimit& threads, const std::function<void(int)>& body);

}  // namespace risorius::experiment
