// SPDX-License-Identifier: MIT
// The published sets of force curves, compared with their sources, and how a file chooses and changes one.

#include "risorius/muscle/curve_sets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "risorius/muscle/published_tables.h"

namespace risorius::muscle {
namespace {

void expect_values(const Curve& curve, const PublishedTable& table) {
    for (const auto& [x, f] : table) EXPECT_NEAR(curve.value(x), f, 1e-5) << "at " << x;
}

// Thelen's formulas as published, with their kinks.
double thelen_passive(double l) {
    return l <= 1 ? 0 : std::expm1(5 * (l - 1) / 0.6) / std::expm1(5.0);
}
double thelen_velocity(double v) {
    if (v <= 0) return (1 + v) / (1 - v / 0.25);
    const double c = (2 + 2 / 0.25) / (1.4 - 1);
    return (1 + 1.4 * c * v) / (1 + c * v);
}
double thelen_tendon(double eps) {
    const double toe = 0.609 * 0.04;
    if (eps <= 0) return 0;
    if (eps <= toe) return 0.33 * std::expm1(3 * eps / toe) / std::expm1(3.0);
    return 0.33 + 1.712 / 0.04 * (eps - toe);
}

double farthest(const Curve& curve, double (*published)(double), double from, double to) {
    double max = 0;
    for (int i = 0; i <= 1000; ++i) {
        const double x = from + (to - from) * i / 1000;
        max = std::max(max, std::abs(curve.value(x) - published(x)));
    }
    return max;
}

TEST(ThelenCurves, AreThePublishedOnesAwayFromTheirKinks) {
    const MuscleCurves curves = thelen_curves();
    for (double l = 0.3; l < 1.8; l += 0.1)
        EXPECT_DOUBLE_EQ(curves.active.value(l), std::exp(-(l - 1) * (l - 1) / 0.45));
    EXPECT_LT(farthest(curves.passive, thelen_passive, 1.12, 1.6), 1e-12);
    EXPECT_LT(farthest(curves.velocity, thelen_velocity, -0.9, 0), 1e-12);
    EXPECT_LT(farthest(curves.velocity, thelen_velocity, 0.04, 1), 1e-12);
    // The rest is the paper's rounding of 0.60862 and 1.71189.
    EXPECT_LT(farthest(curves.tendon, thelen_tendon, 0.0082, 0.05), 1e-3);
}

TEST(ThelenCurves, DifferFromThePublishedOnesAtKinksByWhatTheHeaderSays) {
    const MuscleCurves curves = thelen_curves();
    EXPECT_LT(farthest(curves.passive, thelen_passive, 0.9, 1.12), 0.0011);
    EXPECT_LT(farthest(curves.velocity, thelen_velocity, 0, 0.04), 0.027);
    EXPECT_LT(farthest(curves.velocity, thelen_velocity, -1, -0.9), 0.005);
    EXPECT_LT(farthest(curves.tendon, thelen_tendon, 0, 0.0082), 0.0027);
}

// Control points of the paper's curves, inverted by bisection in another program.
TEST(MillardCurves, HaveTheValuesOfTheirControlPoints) {
    const MuscleCurves curves = millard_curves();
    expect_values(curves.active, {{.4, 0},
                                  {.5, .09853},
                                  {.6, .4511},
                                  {.7, .76702},
                                  {.8, .87068},
                                  {.9, .95676},
                                  {1, 1},
                                  {1.1, .95738},
                                  {1.2, .82368},
                                  {1.3, .68403},
                                  {1.4, .54373},
                                  {1.5, .40334},
                                  {1.6, .26303},
                                  {1.7, .12316},
                                  {1.9, 0}});
    expect_values(curves.passive, {{.9, 0},
                                   {1.02, .00088},
                                   {1.1, .01704},
                                   {1.2, .04969},
                                   {1.3, .12611},
                                   {1.4, .26289},
                                   {1.5, .46026},
                                   {1.6, .71707},
                                   {1.7, 1},
                                   {1.8, 1.28571}});
    expect_values(curves.velocity, {{-1.2, 0},
                                    {-.95, .00285},
                                    {-.75, .05152},
                                    {-.5, .15809},
                                    {-.25, .38733},
                                    {-.1, .62521},
                                    {0, 1},
                                    {.1, 1.22515},
                                    {.25, 1.28321},
                                    {.5, 1.33113},
                                    {.95, 1.39913},
                                    {1.2, 1.4}});
    expect_values(curves.tendon, {{-.01, 0},
                                  {.005, .0376},
                                  {.01, .09968},
                                  {.02, .26094},
                                  {.03, .4794},
                                  {.04, .74745},
                                  {.049, 1},
                                  {.06, 1.30867}});
}

TEST(MillardCurves, AreSmoothInTheSecondDerivativeToo) {
    const MuscleCurves curves = millard_curves();
    const double h = 1e-5;
    for (const Curve* curve : {&curves.active, &curves.velocity})
        for (const double joint : curve->joints()) {
            const auto second = [&](double x) {
                return (curve->at(x + h).slope - curve->at(x - h).slope) / (2 * h);
            };
            // About 10 per 1e-3 beside it.
            EXPECT_NEAR(second(joint - 2 * h), 0, 0.5) << "at " << joint;
            EXPECT_NEAR(second(joint + 2 * h), 0, 0.5) << "at " << joint;
        }
}

TEST(ZajacCurves, FollowThePublishedTables) {
    const MuscleCurves curves = zajac_curves();
    // The peak was moved from (1.045, 0.993) to (1, 1).
    for (const auto& [l, f] : published_active_force())
        EXPECT_NEAR(curves.active.value(l), f, l > 1 && l < 1.1 ? 0.015 : 2e-3) << "at " << l;
    for (const auto& [v, f] : published_velocity_force())
        if (v <= 0) {
            EXPECT_NEAR(curves.velocity.value(v), f, v < -0.95 ? 5e-3 : 1e-6) << "at " << v;
        }
    // The passive table has no smooth toe and ends at 1.6.
    for (const auto& [l, f] : published_passive_force())
        EXPECT_NEAR(curves.passive.value(l), f, 0.2) << "at " << l;
}

CurveShape read(const char* json) {
    return read_curve_shape(
        JsonCursor::from_json({{"curves", Json::parse(json)}}, "muscle.json").at("curves"));
}

std::string refusal_of(const char* json) {
    try {
        read(json);
    } catch (const Error& error) {
        return error.what();
    }
    return "none";
}

TEST(CurveSets, AreChosenByNameAndTunedByNumber) {
    EXPECT_TRUE(std::holds_alternative<ThelenShape>(read(R"("thelen2003")")));
    EXPECT_TRUE(std::holds_alternative<MillardShape>(read(R"({"set": "millard2013"})")));
    const MuscleCurves tuned = make_curves(read(R"({"set": "zajac", "tendon_strain": 0.05,
                 "active_points": [[0.5, 0], [0.7, 0.6], [1, 1], [1.4, 0.5], [1.6, 0]]})"));
    EXPECT_DOUBLE_EQ(tuned.tendon.value(0.05), 1);
    EXPECT_DOUBLE_EQ(tuned.active.value(1.4), 0.5);
    EXPECT_DOUBLE_EQ(
        make_curves(read(R"({"set": "thelen2003", "active_width": 0.2})")).active.value(1.2),
        std::exp(-0.2));
    EXPECT_DOUBLE_EQ(make_curves(read(R"({"set": "millard2013", "lengthening_force": 1.8})"))
                         .velocity.value(1.5),
                     1.8);
}

TEST(CurveSets, WhatCannotBeDrawnIsRefusedByPlace) {
    EXPECT_EQ(
        refusal_of(R"("zajak")"),
        "muscle.json:/curves: expected one of \"zajac\" \"thelen2003\" \"millard2013\", found "
        "\"zajak\"");
    EXPECT_EQ(refusal_of(R"({"set": "hatze"})"),
              "muscle.json:/curves/set: expected one of \"zajac\" \"thelen2003\" \"millard2013\", "
              "found \"hatze\"");
    EXPECT_EQ(refusal_of(R"({"set": "zajac", "passive_strain": -1})"),
              "muscle.json:/curves/passive_strain: expected passive_strain > 0, found -1");
    EXPECT_EQ(refusal_of(R"({"set": "millard2013", "lengthening_end_slope": 0.5})"),
              "muscle.json:/curves/lengthening_end_slope: expected lengthening_end_slope in (0, "
              "lengthening_force - 1), found 0.5");
    EXPECT_EQ(refusal_of(R"({"set": "zajac", "active_points": [[0.5, 0], [0.4, 1], [1.5, 0]]})"),
              "muscle.json:/curves/active_points: expected active_points of growing length, found "
              "[[0.5,0],[0.4,1],[1.5,0]]");
    EXPECT_NE(refusal_of(R"({"set": "thelen2003", "passive_strian": 1})").find("passive_strain"),
              std::string::npos);
    EXPECT_THROW(curve_set_named("hill"), Error);
    EXPECT_THROW(thelen_curves({.passive_exponent = 0.5}), std::invalid_argument);
    EXPECT_THROW(millard_curves({.active_transition = 0.3}), std::invalid_argument);
}

}  // namespace
}  // namespace risorius::muscle
