// SPDX-License-Identifier: MIT
/// \file
/// Experiment files of samples/figures, read as JSON so that a test can shorten them, and what they measured.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "message_of.h"
#include "paths.h"
#include "risorius/core/json_cursor.h"
#include "risorius/figures/registry.h"

namespace risorius::figures {

inline std::filesystem::path samples_folder() {
    return std::filesystem::path(RISORIUS_SOURCE_DIR) / "samples" / "figures";
}

inline Json sample(const std::string& id) {
    return JsonCursor::read_file(samples_folder() / id / "experiment.json").json();
}

/// Removes what a shortened experiment does not measure.
inline void forget_numbers(Json& experiment) {
    for (const char* key : {"checks", "claims", "watched"}) experiment.erase(key);
}

inline FigureResult run(const Json& experiment, const RunOptions& options = {}) {
    return run_figure(JsonCursor::from_json(experiment, "experiment.json"), options);
}

inline const Table& table_of(const FigureResult& figure, const std::string& name) {
    for (const Table& table : figure.tables)
        if (table.name == name) return table;
    throw std::out_of_range("no table " + name);
}

/// A measurement by its name, without the unit.
inline double measured(const FigureResult& figure, const std::string& name) {
    const Table& table = table_of(figure, "measurements");
    for (std::size_t i = 0; i < table.rows.size(); ++i)
        if (table.row_names[i] == name || table.row_names[i].starts_with(name + " ["))
            return table.rows[i][0];
    ADD_FAILURE() << name << " was not measured";
    return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace risorius::figures
