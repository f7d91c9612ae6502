// SPDX-License-Identifier: MIT
// Short versions of the thesis' figures against published ranges, linear theory and numbers measured by an independent
// prototype (3 m cube, 4 kg, held at its top).
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "figures/samples.h"
#include "risorius/figures/detail/body_cases.h"
#include "risorius/figures/detail/linear_modes.h"
#include "risorius/figures/detail/step_search.h"
#include "risorius/softbody/soft_body.h"

namespace risorius::figures {
namespace {

TEST(Figure5, EveryNumberLiesInItsBandAndTheCubesAreDrawn) {
    // The closed form itself: T4a and T4b in tests/tissue/hanging_cube_test.cpp.
    const FigureResult figure = run(sample("5"));
    EXPECT_EQ(figure.checks.size(), 7u);
    for (const Check& check : figure.checks)
        EXPECT_TRUE(check.passes()) << check.name << ": " << check.measured;
    EXPECT_EQ(figure.shapes.size(), 7u);
    EXPECT_EQ(figure.shapes[0].positions.col(2).minCoeff(), 0) << "the first is drawn at rest";
    EXPECT_LT(figure.shapes[1].positions.col(2).minCoeff(), -2);
}

/// The first grids of a run, each with its own step.
void use_grids(Json& entry, const std::vector<int>& grids) {
    Json steps = Json::array();
    for (std::size_t i = 0; i < grids.size(); ++i) steps.push_back(entry["steps_s"][i]);
    entry["grids"] = grids;
    entry["steps_s"] = steps;
}

/// Figure 9 with coarse grids only.
Json short_volume_history(const char* id) {
    Json json = sample(id);
    json["runs"] = Json::array({json["runs"][0]});
    use_grids(json["runs"][0], {3, 4});
    forget_numbers(json);
    return json;
}

TEST(Figure9, CoarseCubesSwellAsPublished) {
    const FigureResult figure = run(short_volume_history("9b"));
    // T5a, b and d. Thesis: up to 10 % at 3^3, decreasing; the sum of dV within 0.01 %. Prototype: 10.8 and 6.7 %,
    // 0.0097 and 0.0037 %.
    const double peak3 = measured(figure, "peak_percent/differences/3x3x3");
    const double peak4 = measured(figure, "peak_percent/differences/4x4x4");
    EXPECT_GT(peak3, 8);
    EXPECT_LT(peak3, 13);
    EXPECT_LT(peak4, peak3);
    EXPECT_NEAR(measured(figure, "peak_time_s/differences/3x3x3"), 0.6, 0.15);
    const double sum3 = measured(figure, "sum_peak_percent/differences/3x3x3");
    const double sum4 = measured(figure, "sum_peak_percent/differences/4x4x4");
    EXPECT_GT(sum3, 0.006);
    EXPECT_LT(sum3, 0.014);
    EXPECT_LT(sum4, sum3);
    // Prototype at rest: 6.96 %.
    EXPECT_NEAR(measured(figure, "last_percent/differences/3x3x3"), 6.96, 0.05 * 6.96);
    EXPECT_LT(measured(figure, "settled_s/differences/3x3x3"), 8);

    ASSERT_EQ(figure.charts.size(), 1u);
    EXPECT_EQ(figure.charts[0].series.size(), 2u);
    EXPECT_EQ(table_of(figure, "volume").rows.size(), 1101u);
}

TEST(Figure9, BothHalvesShareOneRun) {
    Json a = short_volume_history("9a"), b = short_volume_history("9b");
    for (Json* json : {&a, &b}) {
        (*json)["duration_s"] = 0.1;
        use_grids((*json)["runs"][0], {3});
    }
    SharedRuns shared;
    RunOptions options;
    options.shared = &shared;
    int runs = 0;
    options.monitor.progress = [&](double, const std::string&) { ++runs; };
    const FigureResult first = run(a, options), second = run(b, options);
    EXPECT_EQ(runs, 1);
    EXPECT_EQ(table_of(first, "volume").rows, table_of(second, "volume").rows);
    EXPECT_NE(first.charts[0].name, second.charts[0].name);
}

TEST(Figure9, ResultsDoNotDependOnTheNumberOfThreads) {
    Json json = short_volume_history("9b");
    json["duration_s"] = 0.5;
    json["runs"] = Json::array({sample("9b")["runs"][0]});
    use_grids(json["runs"][0], {3, 4, 5});
    const FigureResult one = run(json, {.threads = 1}), three = run(json, {.threads = 3});
    ASSERT_EQ(one.tables.size(), three.tables.size());
    for (std::size_t i = 0; i < one.tables.size(); ++i)
        EXPECT_EQ(one.tables[i].rows, three.tables[i].rows) << one.tables[i].name;
    EXPECT_EQ(one.record.dump(), three.record.dump());
}

TEST(FigureCells, CellsKeepVolumeAndLengthAtEveryResolution) {
    // T6, and T4c of cells. Finite differences at rest are those of tests/tissue/hanging_cube_test.cpp.
    Json json = sample("cells");
    forget_numbers(json);
    Json cells;
    for (const Json& entry : json["runs"])
        if (entry["name"] == "cells-100") cells = entry;
    cells["grids"] = {3, 9};
    json["runs"] = Json::array({cells});
    const FigureResult figure = run(json);

    // The volume error of cells is the mean pressure over the modulus: m g / (6 L^2 K), K = 2 psi_c V0.
    const double expected_percent = 100 * 4 * 9.81 / (6 * 9 * (2 * 100 * 27.0));
    const double error3 = measured(figure, "volume_change_percent/cells-100/3x3x3");
    const double error9 = measured(figure, "volume_change_percent/cells-100/9x9x9");
    EXPECT_NEAR(error3, expected_percent, 0.3 * expected_percent);
    EXPECT_NEAR(error9, expected_percent, 0.2 * expected_percent);
    EXPECT_LT(error9, 0.02);
    EXPECT_LT(measured(figure, "length_spread_percent/cells-100"), 0.5);
    EXPECT_NEAR(measured(figure, "length_ratio/cells-100/9x9x9"), 1.1287, 3e-4) << "prototype";
    for (const char* grid : {"3x3x3", "9x9x9"}) {
        EXPECT_LT(measured(figure, std::string("drift_ratio/cells-100/") + grid), 1e-9);
        EXPECT_LT(measured(figure, std::string("force_ratio/cells-100/") + grid), 1e-6);
    }
}

TEST(Figure12a, StableStepsAreThoseOfThePrototype) {
    // T7a: the prototype's table has 12 steps per decade, so that its limits lie up to 21 % above the numbers.
    struct Row {
        solve::Method method;
        double damping, step_s;
    };
    using solve::Method;
    for (const Row& row :
         {Row{Method::kRungeKutta2, 0.1, 3.8e-4}, Row{Method::kCashKarp, 0.1, 1.5e-3},
          Row{Method::kAdamsBashforth, 0.1, 2.6e-4}, Row{Method::kAdamsMoulton, 0.1, 5.6e-4},
          Row{Method::kEuler, 1, 1.8e-4}, Row{Method::kCashKarp, 10, 6.8e-4},
          Row{Method::kVerlet, 10, 3.8e-4}, Row{Method::kAdamsMoulton, 10, 2.2e-4}}) {
        Json json = sample("12a");
        json["body"]["material"]["damping_ns_per_m3"] = row.damping;
        const softbody::SoftBody body = softbody::build_body(
            softbody::read_body(JsonCursor::from_json(json, "experiment.json").at("body")));
        const StepSearch search{.steps_s = {1.25 * row.step_s, 0.9 * row.step_s},
                                .duration_s = 7.5,
                                .diverged_at = 1000};
        EXPECT_EQ(longest_stable_step(body, row.method, search, {}).step_s, 0.9 * row.step_s)
            << solve::name_of(row.method) << " at " << row.damping;
    }
}

TEST(Figure12a, StableStepsAreThoseOfLinearTheory) {
    // T7a: RK4, Verlet and damped Euler against the frequencies and the damping about the rest state.
    Json json = sample("12a");
    forget_numbers(json);
    json["methods"] = {"euler", "rk4", "verlet"};
    json["varied"]["values"] = {0.1, 10};
    json["steps"] = Json::parse(R"({"longest_s": 3e-3, "shortest_s": 3e-4, "per_decade": 24})");
    const FigureResult figure = run(json);
    for (const char* of : {"rk4/0.1", "rk4/10", "verlet/0.1", "euler/10"}) {
        const double ratio = measured(figure, std::string("ratio/") + of);
        EXPECT_GT(ratio, 0.65) << of;
        EXPECT_LT(ratio, 1.05) << of;
    }
    // On the axes of the domains of stability: 2.83 / w, 2.785 / d and 2 / w.
    EXPECT_NEAR(measured(figure, "predicted_s/rk4/0.1"), 1.84e-3, 0.1 * 1.84e-3);
    EXPECT_NEAR(measured(figure, "predicted_s/rk4/10"), 5.2e-4, 0.1 * 5.2e-4);
    EXPECT_NEAR(measured(figure, "predicted_s/verlet/0.1"), 1.3e-3, 0.1 * 1.3e-3);
    EXPECT_EQ(measured(figure, "step_s/euler/0.1"), 0) << "2.6e-5, below this table";
}

TEST(LinearModes, FrequencyAndDampingOfTheCubeAreThePrototypes) {
    const Json json = sample("12a");
    const softbody::SoftBody body = softbody::build_body(
        softbody::read_body(JsonCursor::from_json(json, "experiment.json").at("body")));
    double fastest = 0, max_damped = 0;
    for (const std::complex<double>& lambda : small_motions(body, body.rest)) {
        fastest = std::max(fastest, std::abs(lambda));
        // A vibration decays by half of what damping takes.
        max_damped = std::max(max_damped, (lambda.imag() == 0 ? -1 : -2) * lambda.real());
        EXPECT_LT(lambda.real(), 1e-3) << "nothing grows by itself";
    }
    EXPECT_NEAR(fastest, 1533, 3);
    EXPECT_LT(max_damped, 53.5) << "1/s, the greatest eigenvalue of D alone, which is of no mode";
    EXPECT_GT(max_damped, 40);
}

TEST(LinearModes, StabilityDomainsReachWhereTextbooksSay) {
    using solve::Method;
    const std::complex<double> decay(-1, 0), turn(0, 1);
    struct Limit {
        Method method;
        std::complex<double> lambda;
        double step_s;
    };
    // Hairer, Norsett & Wanner: real intervals 2, 2, 2.785, 0.3; imaginary 2.828 for order 4, 2 for Verlet.
    for (const Limit& limit :
         {Limit{Method::kEuler, decay, 2}, Limit{Method::kRungeKutta2, decay, 2},
          Limit{Method::kRungeKutta4, decay, 2.785}, Limit{Method::kRungeKutta4, turn, 2.828},
          Limit{Method::kVerlet, decay, 2}, Limit{Method::kVerlet, turn, 2},
          Limit{Method::kAdamsBashforth, decay, 0.3}, Limit{Method::kAdamsMoulton, decay, 1.285}}) {
        EXPECT_LE(growth_per_step(limit.method, limit.lambda, 0.99 * limit.step_s), 1 + 1e-9);
        EXPECT_GT(growth_per_step(limit.method, limit.lambda, 1.01 * limit.step_s), 1);
    }
    EXPECT_GT(growth_per_step(Method::kEuler, turn, 0.01), 1) << "Euler never bears an oscillation";
}

}  // namespace
}  // namespace risorius::figures
