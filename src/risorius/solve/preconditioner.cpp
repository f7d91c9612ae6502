// SPDX-License-Identifier: MIT
#include "risorius/solve/preconditioner.h"

namespace risorius::solve {

namespace {

SparseCholesky factor_of(const MotionSystem& system, double step_s) {
    MetricBuilder builder(system.size());
    system.add_metric(step_s, builder);
    const double rate_hz = 1.0 / step_s;
    for (int i = 0; i < system.size(); ++i)
        builder.add_diagonal(i, system.mass_kg()[i] * rate_hz * rate_hz);
    return SparseCholesky(builder.build(system.fixed()));
}

}  // namespace

PrefactoredMetric::PrefactoredMetric(const MotionSystem& system, double step_s)
    : factor_(factor_of(system, step_s)) {}

}  // namespace risorius::solve
