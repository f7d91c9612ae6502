// SPDX-License-Identifier: MIT
/// \file
/// Brings a body into equilibrium under its loads. The method of the integrator decides whether this is done by simulation or by
/// a static solver.
#pragma once

#include "risorius/figures/detail/run_options.h"
#include "risorius/softbody/soft_body.h"
#include "risorius/solve/integrator.h"

namespace risorius::figures {

struct EquilibriumRun {
    Points x;
    solve::IntegratorReport report;
    double speed_ratio = 0;  ///< maximum speed of a node over the body's length, 1/s
    /// Maximum residual force on a free node over the total weight (over 1 N for a body without weight)
    double force_ratio = 0;
};

/// Simulates for `duration_s`. The quasi-static method solves once instead, and ignores the duration.
EquilibriumRun run_to_equilibrium(const softbody::SoftBody& body,
                                  solve::IntegratorOptions integrator, double duration_s,
                                  const RunOptions& options);

}  // namespace risorius::figures
