// SPDX-License-Identifier: MIT
#include "risorius/figures/detail/hanging_curve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "figures/samples.h"

namespace risorius::figures {
namespace {

TEST(Catenary, EveryPieceIsInBalance) {
    // The pull along the curve has one horizontal part everywhere, and its vertical part grows by the weight below: the
    // slope is linear in the length. The points are close enough that a chord's slope is that of its middle.
    const Vec3 from(0.2, -0.1, 0.5), to(0.6, 0.3, 0.3);
    const int points = 2001;
    const Points x = catenary(from, to, 1.1, points);
    EXPECT_LT((x.row(0).transpose() - from).norm(), 1e-12);
    EXPECT_LT((x.row(points - 1).transpose() - to).norm(), 1e-9);
    double slope_before = 0, step_before = 0;
    for (int i = 0; i + 1 < points; ++i) {
        const Vec3 link = (x.row(i + 1) - x.row(i)).transpose();
        EXPECT_NEAR(link.norm(), 1.1 / (points - 1), 1e-9);
        const double slope = link.z() / link.head<2>().norm();
        if (i > 1) {
            EXPECT_NEAR(slope - slope_before, step_before, 1e-5 * std::abs(step_before));
        }
        step_before = slope - slope_before;
        slope_before = slope;
    }
}

TEST(HangingCurve, ComesToTheCatenaryWithTheSquareOfItsSpacing) {
    Json json = sample("curve");
    json["grids"] = {{11}, {21}};
    forget_numbers(json);
    const FigureResult figure = run(json);
    EXPECT_LT(measured(figure, "distance_ratio/21"), 1e-3);
    EXPECT_NEAR(measured(figure, "order/21"), 2, 0.2);
    EXPECT_LT(std::abs(measured(figure, "sag_error_percent/21")), 0.3);
    EXPECT_LT(measured(figure, "force_ratio/21"), 1e-6);
}

TEST(HangingCurve, WhatCannotHangIsNamed) {
    const auto message = [](const char* pointer, const char* value) {
        Json json = sample("curve");
        json[Json::json_pointer(pointer)] = Json::parse(value);
        return message_of([&] { run(json); });
    };
    EXPECT_EQ(
        message("/body/fixed", R"([{"a1": "first"}])"),
        "experiment.json ([11]):/body/fixed: expected both ends and nothing else, found 1 nodes");
    EXPECT_EQ(message("/body/rest", R"({"path_m": [[0, 0, 0], [1, 0, 0]]})"),
              "experiment.json ([11]):/body/rest: expected a curve that can hang between its ends, "
              "found a "
              "taut or a vertical one");
    EXPECT_EQ(
        message("/body/gravity_m_per_s2", "[1, 0, 0]"),
        "experiment.json ([11]):/body/gravity_m_per_s2: expected a weight along -z, found another");
    EXPECT_EQ(message("/body/rest", R"({"path_m": [[0, 0, 0]]})"),
              "experiment.json ([11]):/body/rest/path_m: expected at least 2 points, found 1");
    EXPECT_EQ(message("/grids/0", "[11, 11]").substr(0, 75),
              "experiment.json ([11,11]):/body/grid: expected one number of nodes, found [");
}

}  // namespace
}  // namespace risorius::figures
