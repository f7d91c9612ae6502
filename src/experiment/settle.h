// Brings a body to rest under what acts on it: by moving in time or by solving for equilibrium, as its integrator says.
#pragma once

#include "body/soft_body.h"
#include "experiment/run_options.h"
#include "solve/integrator.h"

namespace risorius::experiment {

struct Settled {
    Points x;
    solve::IntegratorReport report;
    double speed_ratio = 0;  ///< fastest node times 1 s over the body's length
    double force_ratio =
        0;  ///< greatest force on a free node at rest, over the whole weight (or over 1 N without weight)
};

/// Moves for `duration_s`; the quasi-static method needs one call whatever the duration.
Settled settle(const body::SoftBody& body, solve::IntegratorOptions integrator, double duration_s,
               const RunOptions& options);

}  // namespace risorius::experiment
