// SPDX-License-Identifier: MIT
/// \file
/// The catalogue of a set: stimuli/stimuli.tsv, a row for each clip, and stimuli/stimuli.json, what its columns are.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/stimuli/batch.h"
#include "risorius/stimuli/detail/norms.h"

namespace risorius::stimuli {

inline constexpr const char* kMissingCell = "n/a";  ///< the marker of BIDS for missing values

/// Returns a value as a cell of a table.
std::string catalogue_cell(const Json& value);

struct Catalogue {
    std::string table;
    Json columns;
};

/// `records`: the sidecars of the clips of the plan.
Catalogue catalogue_of(const BatchPlan& plan, const std::vector<Json>& records,
                       const std::optional<Norms>& norms = {});

/// Returns the table of random movements, a row for each clip and active unit. It alone makes the clips again, as "table" of "sample"
/// in a design.
Catalogue sample_of(const BatchPlan& plan, const std::vector<Json>& records);

}  // namespace risorius::stimuli
