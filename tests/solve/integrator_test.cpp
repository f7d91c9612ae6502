// SPDX-License-Identifier: MIT
// Names and options of the methods.
#include "risorius/solve/integrator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace risorius::solve {
namespace {

std::string message_of(const IntegratorOptions& options) {
    try {
        make_integrator(options);
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "";
}

TEST(IntegratorOptions, EveryMethodHasANameThatLeadsBackToIt) {
    EXPECT_EQ(method_names().size(), 12u);
    for (const std::string_view name : method_names()) EXPECT_EQ(name_of(method_named(name)), name);
    EXPECT_EQ(name_of(Method::kCashKarp), "rkck");
    EXPECT_EQ(method_named("quasi-static"), Method::kQuasiStatic);
    EXPECT_TRUE(is_explicit(Method::kBulirschStoer));
    EXPECT_FALSE(is_explicit(Method::kTerzopoulos));
}

TEST(IntegratorOptions, AnUnknownNameIsToldWithTheKnownOnes) {
    try {
        method_named("leapfrog");
        FAIL() << "accepted";
    } catch (const std::invalid_argument& error) {
        EXPECT_STREQ(error.what(),
                     "method: expected one of euler, verlet, rk2, rk4, rkck, bulirsch-stoer, "
                     "adams-bashforth, adams-moulton, terzopoulos, baraff-witkin, implicit-euler, "
                     "quasi-static; found leapfrog");
    }
}

TEST(IntegratorOptions, ValuesOutsideTheirRangesAreNamed) {
    EXPECT_EQ(message_of({}), "");
    EXPECT_EQ(message_of({.step_s = 0}), "step_s: expected (0, inf), found 0");
    EXPECT_EQ(message_of({.step_s = std::nan("")}), "step_s: expected (0, inf), found nan");
    EXPECT_EQ(message_of({.step_s = std::numeric_limits<double>::infinity()}),
              "step_s: expected (0, inf), found inf");
    EXPECT_EQ(message_of({.tolerance = -1e-6}), "tolerance: expected [0, 1), found -1e-06");
    EXPECT_EQ(message_of({.tolerance = 1}), "tolerance: expected [0, 1), found 1");
    EXPECT_EQ(message_of({.length_scale_m = -3}), "length_scale_m: expected (0, inf), found -3");
    EXPECT_EQ(message_of({.min_step_s = -1}), "least_step_s: expected [0, inf), found -1");
    EXPECT_EQ(message_of({.diverged_at = 0}), "diverged_at: expected (0, inf), found 0");
    EXPECT_EQ(message_of({.newton_iterations = 0}),
              "newton_iterations: expected at least 1, found 0");
    EXPECT_EQ(message_of({.newton_tolerance = 0}), "newton_tolerance: expected (0, inf), found 0");
    EXPECT_EQ(message_of({.method = static_cast<Method>(99)}),
              "method: expected one of the enumeration, found 99");
}

TEST(IntegratorReport, AddsCountsAndKeepsTheFirstDivergence) {
    IntegratorReport sum;
    IntegratorReport first;
    first.steps = 3;
    first.evaluations = 12;
    first.rejections = 1;
    first.linear_solves = 2;
    first.error_estimate = 0.5;
    first.converged = false;
    sum.add(first);
    IntegratorReport second;
    second.steps = 1;
    second.error_estimate = 0.25;
    second.diverged = true;
    second.diverged_at_s = 7;
    sum.add(second);
    second.diverged_at_s = 9;
    sum.add(second);
    EXPECT_EQ(sum.steps, 5);
    EXPECT_EQ(sum.evaluations, 12);
    EXPECT_EQ(sum.rejections, 1);
    EXPECT_EQ(sum.linear_solves, 2);
    EXPECT_EQ(sum.error_estimate, 0.5);
    EXPECT_FALSE(sum.converged);
    EXPECT_TRUE(sum.diverged);
    EXPECT_EQ(sum.diverged_at_s, 7);
}

}  // namespace
}  // namespace risorius::solve
