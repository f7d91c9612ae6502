// SPDX-License-Identifier: MIT
/// \file
/// Searches for the largest stable time step of a method. As in the thesis (see registry.h), the steps of a table are tried from
/// the largest down. The result is the first one at which the motion does not diverge.
#pragma once

#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/figures/detail/run_options.h"
#include "risorius/softbody/soft_body.h"
#include "risorius/solve/integrator.h"

namespace risorius::figures {

/// Reads {"longest_s": 1e-2, "shortest_s": 1e-5, "per_decade": 12}; returns the steps in descending order.
std::vector<double> read_step_table(const JsonCursor& json);

/// Reads names of explicit methods with a fixed step, at least one.
std::vector<solve::Method> read_fixed_step_methods(const JsonCursor& json);

/// Returns the name of a method in figure 12 of the thesis, such as "RK4" or "A-B".
std::string label_of(solve::Method method);

struct StepSearch {
    std::vector<double> steps_s;  ///< descending
    double duration_s = 0;
    /// A motion has diverged when a node has moved by this many lengths of the body
    double diverged_at = 1e3;
};

struct StableStep {
    double step_s = 0;     ///< 0: no step of the table is stable
    long evaluations = 0;  ///< force evaluations of the whole search
};

StableStep longest_stable_step(const softbody::SoftBody& body, solve::Method method,
                               const StepSearch& search, const RunOptions& options);

}  // namespace risorius::figures
