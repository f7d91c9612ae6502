// SPDX-License-Identifier: MIT
/// \file
/// Brings a body to rest under what acts on it: by moving in time or by solving for equilibrium, as its integrator says.
#pragma once

#include "risorius/figures/detail/run_options.h"
#include "risorius/softbody/soft_body.h"
#include "risorius/solve/integrator.h"

namespace risorius::figures {

struct EquilibriumRun {
    Points x;
    solve::IntegratorReport report;
    double speed_ratio = 0;  ///< fastest node times 1 s over the body's length
    double force_ratio =
        0;  ///< greatest force on a free node at rest, over the whole weight (or over 1 N without weight)
};

/// Moves for `duration_s`; the quasi-static method needs one call whatever the duration.
EquilibriumRun run_to_equilibrium(const softbody::SoftBody& body,
                                  solve::IntegratorOptions integrator, double duration_s,
                                  const RunOptions& options);

}  // namespace risorius::figures
