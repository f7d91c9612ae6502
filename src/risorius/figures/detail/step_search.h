// SPDX-License-Identifier: MIT
/// \file
/// The longest step of a table with which a method gets through a simulation: as in the thesis, steps are tried from the
/// longest down and the first with which the motion does not diverge counts.
#pragma once

#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/figures/detail/run_options.h"
#include "risorius/softbody/soft_body.h"
#include "risorius/solve/integrator.h"

namespace risorius::figures {

/// {"longest_s": 1e-2, "shortest_s": 1e-5, "per_decade": 12}: steps, longest first.
std::vector<double> read_step_table(const JsonCursor& json);

/// Names of explicit methods with a fixed step, at least one.
std::vector<solve::Method> read_fixed_step_methods(const JsonCursor& json);

/// As the thesis' figure 12 calls it: "RK4", "A-B".
std::string label_of(solve::Method method);

struct StepSearch {
    std::vector<double> steps_s;  ///< longest first
    double duration_s = 0;
    double diverged_at = 1e3;  ///< body lengths a node is away from its start
};

struct StableStep {
    double step_s = 0;     ///< 0: none of the table
    long evaluations = 0;  ///< of the whole search
};

StableStep longest_stable_step(const softbody::SoftBody& body, solve::Method method,
                               const StepSearch& search, const RunOptions& options);

}  // namespace risorius::figures
