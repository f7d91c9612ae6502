// SPDX-License-Identifier: MIT
#include "risorius/figures/detail/equilibrium_run.h"

#include <algorithm>

namespace risorius::figures {
namespace {

constexpr int kPieces = 20;  // a run can be interrupted between these parts

}  // namespace

EquilibriumRun run_to_equilibrium(const softbody::SoftBody& body,
                                  solve::IntegratorOptions integrator, double duration_s,
                                  const RunOptions& options) {
    integrator.length_scale_m = body.length_scale_m;
    const auto steps = solve::make_integrator(integrator);
    solve::MotionState state = body.start();
    body.system.place_fixed(state.t_s, state.x, state.v);

    EquilibriumRun equilibrium;
    const int pieces = integrator.method == solve::Method::kQuasiStatic ? 1 : kPieces;
    for (int piece = 1; piece <= pieces && !equilibrium.report.diverged; ++piece) {
        options.monitor.throw_if_stopped();
        equilibrium.report.add(
            steps->advance(body.system, state, duration_s * piece / static_cast<double>(pieces)));
    }

    equilibrium.x = state.x;
    equilibrium.speed_ratio = state.v.rowwise().norm().maxCoeff() / body.length_scale_m;
    Points force;
    body.system.force(state.t_s, state.x, Points::Zero(state.x.rows(), 3), force);
    for (const int node : body.fixed) force.row(node).setZero();
    const double weight = body.weight_n > 0 ? body.weight_n : 1;
    equilibrium.force_ratio = force.rowwise().norm().maxCoeff() / weight;
    return equilibrium;
}

}  // namespace risorius::figures
