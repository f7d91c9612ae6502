// SPDX-License-Identifier: MIT
// Muscles at rest, in motion and under load on coarse grids: against one fibre and its tendon, Hill's law, and each other.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "figures/samples.h"
#include "risorius/figures/detail/muscle_release.h"
#include "risorius/figures/detail/still_muscle.h"

namespace risorius::figures {
namespace {

/// A sample on a coarse grid, with some of its runs and without checks.
Json coarse(const char* id, const std::vector<const char*>& runs) {
    Json json = sample(id);
    json["muscle"]["grid"] = {3, 3, 3};
    forget_numbers(json);
    Json chosen = Json::array();
    for (const char* name : runs)
        for (const Json& one : json["runs"])
            if (one["name"] == name) chosen.push_back(one);
    json["runs"] = chosen;
    return json;
}

TEST(MuscleStatics, ASlenderMuscleHasTheTensionOfOneFibreAndItsTendon) {
    Json json = coarse("11a", {"slender"});
    json["lengths"] = {0.7, 0.8, 1, 1.2, 1.4};
    const FigureResult figure = run(json);
    EXPECT_LT(measured(figure, "line_error_f0/slender"), 0.02);
    EXPECT_EQ(measured(figure, "unconverged/slender"), 0);
    EXPECT_EQ(measured(figure, "passive_f0/slender/0.8"), 0) << "between slack tendons";
    // T8: total, passive of an independent prototype
    EXPECT_NEAR(measured(figure, "total_f0/slender/1.4"), 0.833, 0.01);
    EXPECT_NEAR(measured(figure, "passive_f0/slender/1.4"), 0.483, 0.02);
    EXPECT_LT(std::abs(measured(figure, "volume_change_percent/slender/0.7")), 0.3);
    EXPECT_EQ(figure.charts.size(), 2u);
    EXPECT_EQ(table_of(figure, "tension_slender").rows.size(), 5u);
}

TEST(MuscleStatics, BetweenPlanesAMuscleIsFibreAndMatrixSideBySideAndItsTendon) {
    Json json = coarse("11a", {"cells"});
    json["lengths"] = {0.5, 0.7, 1, 1.2, 1.5};
    const FigureResult figure = run(json);
    EXPECT_LT(measured(figure, "matrix_error_f0/cells"), 5e-4);
    EXPECT_GT(measured(figure, "line_error_f0/cells"), 0.02) << "without the matrix";
}

TEST(MuscleStatics, AShortenedMuscleIsDrawnBetweenItsPlates) {
    const FigureResult figure = run(coarse("10", {"cells"}));
    ASSERT_EQ(figure.shapes.size(), 2u);
    EXPECT_EQ(figure.shapes[0].name, figure.shapes[1].name) << "side by side";
    const auto distance_m = [](const Shape& shape) {
        return shape.positions.col(0).maxCoeff() - shape.positions.col(0).minCoeff();
    };
    EXPECT_NEAR(distance_m(figure.shapes[0]), 0.060, 1e-12);
    EXPECT_NEAR(distance_m(figure.shapes[1]), 0.050, 1e-12);
    EXPECT_EQ(figure.shapes[1].positions.rows(), 27 + 2 * 9) << "belly and plates";
    EXPECT_GT(measured(figure, "bulge/cells/0.75"), 1.15);
    EXPECT_LT(measured(figure, "bulge/cells/0.75"), 1.23);
}

TEST(MuscleStatics, PennationTakesItsCosineOfTheForce) {
    Json json = coarse("pennation", {"deg-0", "deg-30"});
    json["lengths"] = {0.85, 0.9, 0.95, 1, 1.05};
    const FigureResult figure = run(json);
    const double ratio = measured(figure, "peak_f0/deg-30") / measured(figure, "peak_f0/deg-0");
    EXPECT_NEAR(ratio, std::cos(std::numbers::pi / 6), 0.01);
    EXPECT_NEAR(measured(figure, "speed/deg-0"), 0.318, 0.01) << "Hill's hyperbola at 0.3 F0";
    EXPECT_EQ(figure.charts[1].series.size(), 6u) << "solid and law of force, range and speed";
}

TEST(MuscleStatics, PeakAndRangeOfAParabolaAreItsOwn) {
    std::vector<double> x, y;
    for (double l = 0; l < 2; l += 0.125) {
        x.push_back(l);
        y.push_back(3 - 2 * (l - 1.03) * (l - 1.03));
    }
    const TensionPeak peak = peak_of(x, y, 0.9);
    EXPECT_NEAR(peak.length, 1.03, 1e-12);
    EXPECT_NEAR(peak.force_f0, 3, 1e-12);
    EXPECT_NEAR(peak.range, 2 * std::sqrt(0.15), 0.02) << "chords lie below";
}

TEST(MuscleHistory, TensionComesBackAfterAReleaseInTheTimeOfVmax) {
    Json json = coarse("11b", {"v-10", "v-4"});
    json["phases"] = Json::parse(R"([{"until_s": 0.2, "step_s": 0.02},
        {"until_s": 0.202, "step_s": 1e-4}, {"until_s": 0.24, "step_s": 1e-3},
        {"until_s": 0.4, "step_s": 2e-2}])");
    const FigureResult figure = run(json);
    for (const char* name : {"v-10", "v-4"}) {
        const std::string of = std::string("/") + name;
        EXPECT_NEAR(measured(figure, "before_f0" + of), 0.998, 0.005);
        EXPECT_LT(measured(figure, "least_f0" + of), 0.05);
        EXPECT_NEAR(measured(figure, "final_f0" + of), 0.974, 0.01);
        EXPECT_EQ(measured(figure, "unconverged" + of), 0);
    }
    // T9c. The release itself takes 1 ms.
    EXPECT_NEAR(measured(figure, "t50_s/v-10"), 9.4e-3, 0.1 * 9.4e-3);
    EXPECT_NEAR((measured(figure, "t50_s/v-4") - 1e-3) / (measured(figure, "t50_s/v-10") - 1e-3),
                10.0 / 4, 0.1);
}

TEST(MuscleHistory, TwitchesThatComeFasterAreStrongerAndSmoother) {
    Json json = coarse("twitch", {"single", "20-hz", "80-hz"});
    json["phases"] = Json::parse(R"([{"until_s": 0.12, "step_s": 0.002}])");
    json["runs"][1]["drive"]["pulses"]["count"] = 3;
    json["runs"][2]["drive"]["pulses"]["count"] = 8;
    const FigureResult figure = run(json, {.threads = 1});
    EXPECT_GT(measured(figure, "mean_f0/80-hz"), 1.3 * measured(figure, "mean_f0/20-hz"));
    EXPECT_GT(measured(figure, "fusion/80-hz"), 1.5 * measured(figure, "fusion/20-hz"));
    EXPECT_GT(measured(figure, "peak_f0/20-hz"), measured(figure, "peak_f0/single"));
    EXPECT_LT(measured(figure, "half_relaxation_s/single"), 0.06);

    const FigureResult again = run(json, {.threads = 3});
    for (const char* name : {"history_single", "history_20-hz", "history_80-hz"})
        EXPECT_EQ(table_of(figure, name).rows, table_of(again, name).rows) << name;
}

TEST(MuscleVelocity, MovingMusclesPullAndLiftByTheLawOfTheirFibres) {
    Json json = coarse("force-velocity", {"muscle"});
    json["speeds"] = {-0.5, -0.25, 0.1};
    json["loads_f0"] = {0.1, 0.5};
    json["steps"] = 40;
    const FigureResult figure = run(json);
    EXPECT_EQ(measured(figure, "missed/muscle"), 0);
    EXPECT_LT(measured(figure, "law_error_f0/muscle"), 0.01);
    // Hill's hyperbola with a / F0 = 0.25, as in the table of Zajac and Delp
    EXPECT_NEAR(measured(figure, "force_f0/muscle/speed/-0.5"), 0.16667, 0.005);
    EXPECT_NEAR(measured(figure, "force_f0/muscle/speed/-0.25"), 0.375, 0.005);
    EXPECT_NEAR(measured(figure, "fibre_speed/muscle/load/0.5"), -0.16667, 0.005);
    EXPECT_NEAR(measured(figure, "hill_a_f0/muscle"), 0.25, 0.02);
    EXPECT_NEAR(measured(figure, "hill_vmax/muscle"), 1, 0.03);
}

TEST(MuscleVelocity, HillsHyperbolaIsFoundThroughItsPoints) {
    std::vector<double> force, speed;
    for (const double v : {0.1, 0.4, 0.7}) {
        force.push_back((1 - v / 0.8) / (1 + v / (0.8 * 0.3)));
        speed.push_back(v);
    }
    const Hill hill = hill_through(force, speed);
    EXPECT_NEAR(hill.a_f0, 0.3, 1e-12);
    EXPECT_NEAR(hill.max_speed, 0.8, 1e-12);
}

TEST(MuscleCurves, EveryNumberOfThePublishedSetsLiesInItsBand) {
    const FigureResult figure = run(sample("muscle-curves"));
    EXPECT_GT(figure.checks.size() + figure.watched.size(), 30u);
    EXPECT_TRUE(figure.passes());
    EXPECT_EQ(figure.charts.size(), 3u);
}

TEST(MuscleKinds, AMuscleOfAnotherSetOfCurvesIsHeldAgainstItsOwn) {
    Json json = coarse("11a", {"slender"});
    json["lengths"] = {0.9, 1.3};
    const double zajac = measured(run(json), "active_f0/slender/1.3");
    json["muscle"]["musculotendon"]["curves"] = "thelen2003";
    const FigureResult figure = run(json);
    EXPECT_LT(measured(figure, "line_error_f0/slender"), 0.02);
    EXPECT_GT(measured(figure, "active_f0/slender/1.3"), zajac + 0.1) << "its bell is wider";
}

}  // namespace
}  // namespace risorius::figures
