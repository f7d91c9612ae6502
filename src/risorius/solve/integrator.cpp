// SPDX-License-Identifier: MIT
// Names of the methods, the check of their options, and the choice of the class for each.
#include "risorius/solve/integrator.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "risorius/solve/detail/methods.h"

namespace risorius::solve {

namespace {

struct NamedMethod {
    Method method;
    std::string_view name;
};

constexpr std::array<NamedMethod, 12> kMethods = {{
    {Method::kEuler, "euler"},
    {Method::kVerlet, "verlet"},
    {Method::kRungeKutta2, "rk2"},
    {Method::kRungeKutta4, "rk4"},
    {Method::kCashKarp, "rkck"},
    {Method::kBulirschStoer, "bulirsch-stoer"},
    {Method::kAdamsBashforth, "adams-bashforth"},
    {Method::kAdamsMoulton, "adams-moulton"},
    {Method::kTerzopoulos, "terzopoulos"},
    {Method::kBaraffWitkin, "baraff-witkin"},
    {Method::kImplicitEuler, "implicit-euler"},
    {Method::kQuasiStatic, "quasi-static"},
}};

template <class Number>
void require(bool holds, const char* name, const char* range, Number found) {
    if (holds) return;
    std::ostringstream text;
    text << name << ": expected " << range << ", found " << found;
    throw std::invalid_argument(text.str());
}

bool is_positive(double value) { return value > 0 && std::isfinite(value); }

void check(const IntegratorOptions& options) {
    require(is_positive(options.step_s), "step_s", "(0, inf)", options.step_s);
    require(options.tolerance >= 0 && options.tolerance < 1, "tolerance", "[0, 1)",
            options.tolerance);
    require(is_positive(options.length_scale_m), "length_scale_m", "(0, inf)",
            options.length_scale_m);
    require(options.min_step_s >= 0 && std::isfinite(options.min_step_s), "least_step_s",
            "[0, inf)", options.min_step_s);
    require(is_positive(options.diverged_at), "diverged_at", "(0, inf)", options.diverged_at);
    require(options.newton_iterations >= 1, "newton_iterations", "at least 1",
            options.newton_iterations);
    require(is_positive(options.newton_tolerance), "newton_tolerance", "(0, inf)",
            options.newton_tolerance);
}

}  // namespace

const std::vector<std::string_view>& method_names() {
    static const std::vector<std::string_view> names = [] {
        std::vector<std::string_view> list;
        for (const NamedMethod& entry : kMethods) list.push_back(entry.name);
        return list;
    }();
    return names;
}

Method method_named(std::string_view name) {
    std::string expected;
    for (const NamedMethod& entry : kMethods) {
        if (entry.name == name) return entry.method;
        expected += expected.empty() ? "" : ", ";
        expected += entry.name;
    }
    throw std::invalid_argument("method: expected one of " + expected + "; found " +
                                std::string(name));
}

std::string_view name_of(Method method) {
    for (const NamedMethod& entry : kMethods)
        if (entry.method == method) return entry.name;
    throw std::invalid_argument("method: expected one of the enumeration, found " +
                                std::to_string(static_cast<int>(method)));
}

bool is_explicit(Method method) {
    switch (method) {
        case Method::kTerzopoulos:
        case Method::kBaraffWitkin:
        case Method::kImplicitEuler:
        case Method::kQuasiStatic:
            return false;
        default:
            return true;
    }
}

void IntegratorReport::add(const IntegratorReport& later) {
    steps += later.steps;
    evaluations += later.evaluations;
    rejections += later.rejections;
    linear_solves += later.linear_solves;
    error_estimate = std::max(error_estimate, later.error_estimate);
    if (!diverged && later.diverged) {
        diverged = true;
        diverged_at_s = later.diverged_at_s;
    }
    converged = converged && later.converged;
}

std::unique_ptr<Integrator> make_integrator(const IntegratorOptions& options) {
    check(options);
    switch (options.method) {
        case Method::kEuler:
            return detail::make_euler(options);
        case Method::kVerlet:
            return detail::make_verlet(options);
        case Method::kRungeKutta2:
            return detail::make_runge_kutta_2(options);
        case Method::kRungeKutta4:
            return detail::make_runge_kutta_4(options);
        case Method::kCashKarp:
            return detail::make_cash_karp(options);
        case Method::kBulirschStoer:
            return detail::make_bulirsch_stoer(options);
        case Method::kAdamsBashforth:
        case Method::kAdamsMoulton:
            return detail::make_adams(options);
        case Method::kTerzopoulos:
            return detail::make_terzopoulos(options);
        case Method::kBaraffWitkin:
            return detail::make_baraff_witkin(options);
        case Method::kImplicitEuler:
            return detail::make_implicit_euler(options);
        case Method::kQuasiStatic:
            return detail::make_quasi_static(options);
    }
    name_of(options.method);  // throws
    return nullptr;
}

}  // namespace risorius::solve
