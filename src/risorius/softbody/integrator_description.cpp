// SPDX-License-Identifier: MIT
#include "risorius/softbody/integrator_description.h"

#include "risorius/softbody/detail/read_numbers.h"

namespace risorius::softbody {

using detail::positive;

solve::IntegratorOptions read_integrator(const JsonCursor& json) {
    json.allow_keys({"method", "step_s", "tolerance", "least_step_s", "diverged_at",
                     "newton_iterations", "newton_tolerance", "curvature", "linear", "lag_rate"});
    solve::IntegratorOptions options;
    options.method = solve::method_named(json.at("method").one_of(solve::method_names()));
    if (const auto step = json.find("step_s")) options.step_s = positive(*step);
    if (const auto tolerance = json.find("tolerance"))
        options.tolerance = tolerance->number({0, 0.5});
    if (const auto min = json.find("least_step_s")) options.min_step_s = positive(*min);
    if (const auto diverged = json.find("diverged_at")) options.diverged_at = positive(*diverged);
    if (const auto iterations = json.find("newton_iterations"))
        options.newton_iterations = iterations->integer(1, 10000);
    if (const auto tolerance = json.find("newton_tolerance"))
        options.newton_tolerance = positive(*tolerance);
    if (const auto curvature = json.find("curvature"))
        options.curvature = curvature->one_of({"exact", "positive"}) == "exact"
                                ? solve::Curvature::kExact
                                : solve::Curvature::kPositive;
    if (const auto linear = json.find("linear"))
        options.linear = linear->one_of({"direct", "conjugate"}) == "direct"
                             ? solve::LinearSolver::kDirect
                             : solve::LinearSolver::kConjugate;
    if (const auto lag = json.find("lag_rate")) options.lag_rate = lag->boolean();
    return options;
}

}  // namespace risorius::softbody
