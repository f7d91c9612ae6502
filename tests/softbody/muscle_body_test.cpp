// SPDX-License-Identifier: MIT
// An isolated muscle, compared with the one-dimensional equilibrium of fibre and tendon, and the behaviour of its belly.

#include "risorius/softbody/muscle_body.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "risorius/core/error.h"
#include "risorius/solve/integrator.h"
#include "risorius/tissue/grid_shape.h"

namespace risorius::softbody {
namespace {

// The prototype muscle: 40 mm long, 10 mm in radius, 0.30 MPa of specific tension.
MuscleDescription prototype(Discretisation discretisation, const tissue::GridShape& grid) {
    MuscleDescription d;
    d.place = "muscle";
    d.discretisation = discretisation;
    d.grid = grid;
    d.length_m = 0.04;
    d.width_m = d.thickness_m = 0.02;
    d.moduli = {.mu_pa = 2e3,
                .bulk_pa = discretisation == Discretisation::kCells ? 5e6 : 0.2e6,
                .viscosity_pa_s = 200};
    d.musculotendon = {.f0_n = 94.2,
                       .optimal_length_m = 0.04,
                       .tendon_slack_m = 0.02,
                       .max_speed_hz = 10,
                       .pennation_deg = 0,
                       .damping = 0.1};
    return d;
}

/// The plates move within 0.1 s to the normalised length (lMT - lTs) / l0. They start in the rest shape, where it is 1.
MuscleBody stretched_to(const MuscleDescription& d, double normalised, double activation) {
    return build_muscle(d, {.activation = [activation](double) { return activation; },
                            .lengthening_m =
                                [=](double t_s) {
                                    return (normalised - 1) * d.musculotendon.optimal_length_m *
                                           std::min(1.0, t_s / 0.1);
                                }});
}

solve::MotionState settle(const MuscleBody& muscle, double duration_s, double step_s = 0.01) {
    const auto integrator = solve::make_integrator({.method = solve::Method::kImplicitEuler,
                                                    .step_s = step_s,
                                                    .length_scale_m = muscle.body.length_scale_m});
    solve::MotionState state = muscle.body.start();
    const solve::IntegratorReport report =
        integrator->advance(muscle.body.system, state, duration_s);
    EXPECT_FALSE(report.diverged);
    EXPECT_TRUE(report.converged);
    return state;
}

/// Solves fT(eps) = a fl(lm) + fp(lm) with lm = Dl - eps lTs / l0, by bisection.
double tension_of_one_fibre(double normalised, double a) {
    const muscle::MuscleCurves curves = muscle::zajac_curves();
    double low = 0, high = 0.2;
    for (int i = 0; i < 60; ++i) {
        const double eps = (low + high) / 2;
        const double lm = normalised - eps * 0.5;
        const bool too_slack =
            curves.tendon.value(eps) < a * curves.active.value(lm) + curves.passive.value(lm);
        (too_slack ? low : high) = eps;
    }
    return curves.tendon.value(low);
}

double tension_at(const MuscleDescription& d, double normalised, double activation) {
    const MuscleBody muscle = stretched_to(d, normalised, activation);
    const solve::MotionState state = settle(muscle, 0.4);
    return muscle.tension(state.t_s, state.x);
}

TEST(MuscleBody, ActiveTensionOfDifferencesIsThatOfTheOneDimensionalEquilibrium) {
    const MuscleDescription d = prototype(Discretisation::kDifferences, {4, 3, 3});
    for (const double length : {0.6, 0.8, 1.0, 1.2, 1.4, 1.5}) {
        // A muscle that is slack without activation floats freely; it has no tension.
        const double passive = length > 1.0 ? tension_at(d, length, 0) : 0.0;
        const double active = tension_at(d, length, 1) - passive;
        const double expected = tension_of_one_fibre(length, 1) - tension_of_one_fibre(length, 0);
        EXPECT_NEAR(active, expected, 0.04) << length;
    }
}

TEST(MuscleBody, TensionOverLengthIsThatOfThePublishedTable) {
    // The prototype muscle in differences, 6 x 6 x 6 nodes, with its peak at the optimal length.
    const MuscleDescription d = prototype(Discretisation::kDifferences, {4, 3, 3});
    const double table[][2] = {{0.6, 0.465}, {0.8, 0.896}, {0.9, 0.953}, {1.0, 0.998},
                               {1.1, 0.969}, {1.2, 0.879}, {1.4, 0.833}};
    for (const auto& [length, total] : table)
        EXPECT_NEAR(tension_at(d, length, 1), total, 0.01) << length;
    EXPECT_NEAR(tension_at(d, 1.4, 0), 0.483, 0.01);
    EXPECT_NEAR(tension_at(d, 1.5, 0), 1.148, 0.01);
}

TEST(MuscleBody, EquilibriumIsWhereMotionEnds) {
    const MuscleBody muscle = stretched_to(prototype(Discretisation::kCells, {4, 3, 3}), 1.2, 1);
    solve::MotionState state = settle(muscle, 0.6);
    const double tension = muscle.tension(state.t_s, state.x);
    const auto still = solve::make_integrator({.method = solve::Method::kQuasiStatic,
                                               .step_s = 1,
                                               .length_scale_m = muscle.body.length_scale_m});
    EXPECT_TRUE(still->advance(muscle.body.system, state, 1).converged);
    EXPECT_NEAR(muscle.tension(state.t_s, state.x), tension, 1e-3);
}

TEST(MuscleBody, SegmentsInSeriesDoNotRunApartOnTheFallingLimb) {
    for (const auto discretisation : {Discretisation::kDifferences, Discretisation::kCells}) {
        const MuscleBody muscle = stretched_to(prototype(discretisation, {6, 3, 3}), 1.25, 1);
        const double early = muscle.musculotendon->segment_spread(settle(muscle, 0.5, 0.025).x);
        const double late = muscle.musculotendon->segment_spread(settle(muscle, 2.5, 0.025).x);
        EXPECT_NEAR(late, early, 0.01);
        // Incompressible cells narrow more in the middle than beside the tendons. This spreads their segments more than in
        // differences, whose volume is less strictly preserved.
        EXPECT_LT(late, discretisation == Discretisation::kDifferences ? 0.05 : 0.08);
    }
}

/// True when Zajac's experiment (full activation, plates 2 mm farther apart than in the rest shape) diverges within 0.1 s.
bool diverges(solve::Method method, int nodes_per_edge, double step_s) {
    const int n = nodes_per_edge;
    const MuscleBody muscle = build_muscle(
        prototype(Discretisation::kDifferences, {n, n, n}),
        {.activation = [](double) { return 1.0; }, .lengthening_m = [](double) { return 0.002; }});
    const auto integrator = solve::make_integrator({.method = method,
                                                    .step_s = step_s,
                                                    .length_scale_m = muscle.body.length_scale_m,
                                                    .diverged_at = 1});
    solve::MotionState state = muscle.body.start();
    return integrator->advance(muscle.body.system, state, 0.1).diverged;
}

// Cells of the table in samples/figures/12b, with twelve steps per decade. A method is stable below its maximum stable step,
// and diverges two steps of the table above it.
TEST(MuscleBody, ExplicitMethodsGetThroughWithTheStepsOfTheTableAndNotWithHalfAsMuchMore) {
    const double down = std::pow(10, -1.0 / 12), up = 1.01 / (down * down);
    const struct {
        solve::Method method;
        double longest_s;
    } cells[] = {{solve::Method::kCashKarp, 3.8e-5},     {solve::Method::kRungeKutta4, 3.2e-5},
                 {solve::Method::kVerlet, 3.2e-5},       {solve::Method::kRungeKutta2, 2.6e-5},
                 {solve::Method::kAdamsMoulton, 1.5e-5}, {solve::Method::kAdamsBashforth, 3.8e-6}};
    for (const auto& [method, longest_s] : cells) {
        EXPECT_FALSE(diverges(method, 3, longest_s * down)) << solve::name_of(method);
        EXPECT_TRUE(diverges(method, 3, longest_s * up)) << solve::name_of(method);
    }
}

// With h ~ nodes^-0.75, the limit of 125 nodes is between 0.25 and 0.4 times that of 27, for exponents from -0.6 to -0.9.
TEST(MuscleBody, TheLongestStableStepOfRungeKutta4FallsAsTheNodesGrow) {
    constexpr double kLongest27_s = 3.2e-5;
    EXPECT_FALSE(diverges(solve::Method::kRungeKutta4, 5, 0.25 * kLongest27_s));
    EXPECT_TRUE(diverges(solve::Method::kRungeKutta4, 5, 0.4 * kLongest27_s));
}

Json described() {
    return Json::parse(R"({"discretisation": "cells", "grid": [4, 3, 3], "section": "block",
        "length_m": 0.05, "width_m": 0.02, "thickness_m": 0.01,
        "moduli": {"shear_pa": 2000, "bulk_pa": 5e6, "viscosity_pa_s": 10, "density_kg_per_m3": 1060},
        "musculotendon": {"f0_n": 60, "optimal_length_m": 0.05, "tendon_slack_m": 0.02}})");
}

MuscleDescription read(const Json& json) {
    return read_muscle(JsonCursor::from_json(Json{{"muscle", json}}, "head.json").at("muscle"));
}

TEST(MuscleBody, DescriptionsAreReadAndBuilt) {
    const MuscleBody block = build_muscle(read(described()), {[](double) { return 0.0; }});
    EXPECT_EQ(block.body.rest.rows(), 36);
    EXPECT_NEAR(block.body.volume(block.body.rest), 0.05 * 0.02 * 0.01, 1e-18);
    EXPECT_NEAR(block.body.system.mass_kg().sum(), 1060 * 0.05 * 0.02 * 0.01, 1e-15);
    Json round = described();
    round["section"] = "round";
    round["grid"] = {4, 9, 9};
    const MuscleBody flat = build_muscle(read(round), {[](double) { return 0.0; }});
    // Nine nodes make a polygon of 32 edges from the ellipse.
    EXPECT_NEAR(flat.body.volume(flat.body.rest) / (std::numbers::pi / 4 * 0.05 * 0.02 * 0.01), 1,
                0.01);
}

TEST(MuscleBody, WhatIsWrongInADescriptionIsNamed) {
    const auto message = [](const char* pointer, const Json& value) -> std::string {
        Json json = described();
        json[Json::json_pointer(pointer)] = value;
        try {
            read(json);
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_EQ(message("/musculotendon/f0_n", -1),
              "head.json:/muscle/musculotendon/f0_n: expected (0, inf), found -1");
    EXPECT_EQ(message("/musculotendon/optimal_length_m", 0),
              "head.json:/muscle/musculotendon/optimal_length_m: expected (0, inf), found 0");
    EXPECT_EQ(message("/musculotendon/pennation_deg", 90),
              "head.json:/muscle/musculotendon/pennation_deg: expected [0, 90), found 90");
    EXPECT_EQ(message("/length_m", 0),
              "head.json:/muscle/length_m: expected a number in (0, inf), found 0");
    EXPECT_EQ(message("/thickness_m", nullptr),
              "head.json:/muscle/thickness_m: expected a number in (0, inf), found null");
    EXPECT_EQ(message("/grid/1", 1),
              "head.json:/muscle/grid/1: expected an integer in [2, 1000], found 1");
    EXPECT_EQ(message("/moduli/shear_pa", -2000),
              "head.json:/muscle/moduli/shear_pa: expected a number in (0, inf), found -2000");
    EXPECT_EQ(message("/moduli/bulk_pa", -1),
              "head.json:/muscle/moduli/bulk_pa: expected [0, inf), found -1");
    EXPECT_EQ(message("/moduli/viscosity_pa_s", -1),
              "head.json:/muscle/moduli/viscosity_pa_s: expected [0, inf), found -1");
    EXPECT_EQ(message("/moduli/density_kg_per_m3", -1060),
              "head.json:/muscle/moduli/density_kg_per_m3: expected a number in (0, inf), found "
              "-1060");
    EXPECT_EQ(message("/section", "oval"),
              "head.json:/muscle/section: expected one of \"block\" \"round\", found \"oval\"");
}

}  // namespace
}  // namespace risorius::softbody
