// SPDX-License-Identifier: MIT
#include "risorius/figures/detail/step_search.h"

#include <cmath>
#include <string_view>

namespace risorius::figures {
namespace {

constexpr int kPieces = 50;  // a run can be interrupted between these parts

bool survives(const softbody::SoftBody& body, const solve::IntegratorOptions& integrator,
              double duration_s, const RunOptions& options, long& evaluations) {
    const auto steps = solve::make_integrator(integrator);
    solve::MotionState state = body.start();
    for (int piece = 1; piece <= kPieces; ++piece) {
        options.monitor.throw_if_stopped();
        const solve::IntegratorReport report =
            steps->advance(body.system, state, duration_s * piece / static_cast<double>(kPieces));
        evaluations += report.evaluations;
        if (report.diverged) return false;
    }
    return true;
}

}  // namespace

std::vector<double> read_step_table(const JsonCursor& json) {
    json.allow_keys({"longest_s", "shortest_s", "per_decade"});
    const double longest = json.at("longest_s").number({1e-12, 1e6});
    const double shortest = json.at("shortest_s").number({1e-12, longest});
    const int per_decade = json.at("per_decade").integer(1, 1000);
    std::vector<double> steps;
    for (int i = 0;; ++i) {
        const double step = longest * std::pow(10.0, -static_cast<double>(i) / per_decade);
        if (step < shortest * (1 - 1e-9)) return steps;
        steps.push_back(step);
    }
}

std::vector<solve::Method> read_fixed_step_methods(const JsonCursor& json) {
    std::vector<std::string_view> names;
    for (const std::string_view name : solve::method_names()) {
        const solve::Method method = solve::method_named(name);
        if (solve::is_explicit(method) && method != solve::Method::kBulirschStoer)
            names.push_back(name);
    }
    std::vector<solve::Method> methods;
    for (const JsonCursor& name : json.items())
        methods.push_back(solve::method_named(name.one_of(names)));
    if (methods.empty()) json.fail("at least one method");
    return methods;
}

std::string label_of(solve::Method method) {
    switch (method) {
        case solve::Method::kEuler:
            return "Euler";
        case solve::Method::kVerlet:
            return "Verlet";
        case solve::Method::kRungeKutta2:
            return "RK2";
        case solve::Method::kRungeKutta4:
            return "RK4";
        case solve::Method::kCashKarp:
            return "RKCK";
        case solve::Method::kAdamsBashforth:
            return "A-B";
        case solve::Method::kAdamsMoulton:
            return "A-M";
        default:
            return std::string(solve::name_of(method));
    }
}

StableStep longest_stable_step(const softbody::SoftBody& body, solve::Method method,
                               const StepSearch& search, const RunOptions& options) {
    solve::IntegratorOptions integrator;
    integrator.method = method;
    integrator.length_scale_m = body.length_scale_m;
    integrator.diverged_at = search.diverged_at;
    StableStep found;
    for (const double step_s : search.steps_s) {
        integrator.step_s = step_s;
        if (!survives(body, integrator, search.duration_s, options, found.evaluations)) continue;
        found.step_s = step_s;
        break;
    }
    return found;
}

}  // namespace risorius::figures
