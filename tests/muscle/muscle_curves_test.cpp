// SPDX-License-Identifier: MIT
// The force curves of a musculotendon, compared with tabulated values; their slopes and integrals, compared with differences.

#include "risorius/muscle/muscle_curves.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "risorius/muscle/curve_sets.h"

namespace risorius::muscle {
namespace {

using Table = std::vector<std::pair<double, double>>;

void expect_values(const Curve& curve, const Table& table, double tolerance) {
    for (const auto& [x, f] : table) {
        EXPECT_NEAR(curve.value(x), f, tolerance) << "at " << x;
        EXPECT_EQ(curve.at(x).value, curve.value(x)) << "at " << x;
    }
}

// Values computed independently from the formulas, with five decimals.
TEST(MuscleCurves, ActiveForceFollowsZajacsPoints) {
    const MuscleCurves curves = zajac_curves();
    expect_values(curves.active,
                  {{0.3, 0},
                   {0.5, .15363},
                   {0.6, .52417},
                   {0.7, .82616},
                   {0.8, .92332},
                   {0.9, .96987},
                   {1.0, 1},
                   {1.1, .94180},
                   {1.2, .80043},
                   {1.3, .58853},
                   {1.4, .33118},
                   {1.5, .12993},
                   {1.7, 0}},
                  1e-5);
    expect_values(curves.active,
                  {{.527, .227}, {.629, .637}, {.719, .857}, {.861, .950}, {1.218, .770}}, 1e-14);
}

TEST(MuscleCurves, ActiveForceNeverExceedsItsPeakAtOptimalLength) {
    const Curve curve = zajac_curves().active;
    for (double l = 0.3; l < 1.8; l += 1e-3) {
        EXPECT_LE(curve.value(l), 1.0) << "at " << l;
        EXPECT_GE(curve.value(l), 0.0) << "at " << l;
    }
}

TEST(MuscleCurves, PassiveForceRisesFromRestLength) {
    expect_values(zajac_curves().passive,
                  {{0.7, 0},
                   {1.0, 0},
                   {1.1, .00990},
                   {1.2, .05612},
                   {1.3, .18740},
                   {1.4, .51791},
                   {1.47, 1},
                   {1.5, 1.27591},
                   {1.6, 2.19561}},
                  1e-5);
}

TEST(MuscleCurves, VelocityForceIsHillsHyperbolaAndResistsLengthening) {
    expect_values(zajac_curves().velocity,
                  {{-1.2, 0},
                   {-1, .00496},
                   {-.75, .06250},
                   {-.5, .16667},
                   {-.25, .37500},
                   {-.1, .64286},
                   {0, 1},
                   {.1, 1.22222},
                   {.25, 1.30303},
                   {.5, 1.34483},
                   {1, 1.37037}},
                  1e-5);
}

TEST(MuscleCurves, TendonPullsOnlyWhenStretchedAndWithF0AtItsStrain) {
    const Curve curve = zajac_curves().tendon;
    expect_values(curve,
                  {{-.01, 0},
                   {0, 0},
                   {.01, .03558},
                   {.02, .27503},
                   {.025, .55075},
                   {.03, .83153},
                   {.033, 1},
                   {.05, 1.95466}},
                  1e-5);
    EXPECT_NEAR(curve.at(.04).slope, 56.157, 1e-3);
    EXPECT_NEAR(curve.joints().back(), .0211285, 1e-7);
}

struct NamedCurve {
    std::string name;
    Curve curve;
    double from, to;
};

/// The curves of every set.
std::vector<NamedCurve> all_curves() {
    std::vector<NamedCurve> all;
    for (const std::string_view set : curve_set_names()) {
        const std::string name(set);
        const MuscleCurves curves = make_curves(curve_set_named(name));
        all.push_back({name + " active", curves.active, 0.3, 1.9});
        all.push_back({name + " passive", curves.passive, 0.8, 1.9});
        all.push_back({name + " velocity", curves.velocity, -1.3, 1.5});
        all.push_back({name + " tendon", curves.tendon, -.01, .06});
    }
    return all;
}

TEST(MuscleCurves, SlopesAndIntegralsAgreeWithDifferences) {
    for (const NamedCurve& c : all_curves()) {
        const double h = (c.to - c.from) * 1e-6;
        // The shift keeps the samples away from the joints, where the second derivative jumps.
        for (int i = 0; i <= 211; ++i) {
            const double x = c.from + (c.to - c.from) * (i + 0.137) / 212;
            const Curve::Value at = c.curve.at(x);
            const double slope = (c.curve.value(x + h) - c.curve.value(x - h)) / (2 * h);
            const double value =
                (c.curve.at(x + h).integral - c.curve.at(x - h).integral) / (2 * h);
            EXPECT_NEAR(at.slope, slope, 1e-7 * (1 + std::abs(slope))) << c.name << " at " << x;
            EXPECT_NEAR(at.value, value, 1e-8) << c.name << " at " << x;
        }
    }
}

TEST(MuscleCurves, NeitherValueNorSlopeNorIntegralJumpsAtAJoint) {
    for (const NamedCurve& c : all_curves()) {
        for (const double joint : c.curve.joints()) {
            const Curve::Value left = c.curve.at(std::nextafter(joint, joint - 1));
            const Curve::Value right = c.curve.at(joint);
            EXPECT_NEAR(left.value, right.value, 1e-12) << c.name << " at " << joint;
            EXPECT_NEAR(left.slope, right.slope, 1e-11) << c.name << " at " << joint;
            EXPECT_NEAR(left.integral, right.integral, 1e-14) << c.name << " at " << joint;
        }
    }
}

TEST(MuscleCurves, EverySetIsNormalised) {
    for (const std::string_view set : curve_set_names()) {
        const MuscleCurves curves = make_curves(curve_set_named(std::string(set)));
        EXPECT_DOUBLE_EQ(curves.active.value(1), 1) << set;
        EXPECT_NEAR(curves.active.at(1).slope, 0, 1e-12) << set;
        EXPECT_EQ(curves.passive.value(1), 0) << set;
        EXPECT_DOUBLE_EQ(curves.velocity.value(0), 1) << set;
        EXPECT_EQ(curves.tendon.value(0), 0) << set;
        // A convex potential needs a resistance that never falls. Every curve but the active one has it.
        for (double x = -1.3; x < 1.5; x += 0.01) {
            EXPECT_GE(curves.velocity.at(x).slope, 0) << set << " at " << x;
            EXPECT_GE(curves.passive.at(x + 1).slope, 0) << set << " at " << x + 1;
            EXPECT_GE(curves.tendon.at(x / 20).slope, 0) << set << " at " << x / 20;
        }
    }
}

TEST(MuscleCurves, PointsOfTheActiveCurveCanBeTuned) {
    ZajacShape shape;
    shape.active_points = {{0.5, 0}, {1, 1}, {1.5, 0}};
    const Curve curve = zajac_curves(shape).active;
    EXPECT_DOUBLE_EQ(curve.value(1), 1);
    EXPECT_DOUBLE_EQ(curve.value(0.75), 0.5);  // smooth step between two flat ends
    EXPECT_EQ(curve.value(1.6), 0);
}

TEST(MuscleCurves, ShapesOutsideTheirRangesAreRefused) {
    EXPECT_THROW(zajac_curves({.active_points = {{0.5, 0}, {1, 1}}}), std::invalid_argument);
    EXPECT_THROW(zajac_curves({.active_points = {{0.5, 0}, {1, 1}, {0.9, 0}}}),
                 std::invalid_argument);
    EXPECT_THROW(zajac_curves({.active_points = {{0.5, 0}, {0.7, 0.5}, {1, 1}}}),
                 std::invalid_argument);
    EXPECT_THROW(zajac_curves({.passive_strain = 0}), std::invalid_argument);
    EXPECT_THROW(zajac_curves({.lengthening_force = 1}), std::invalid_argument);
    EXPECT_THROW(zajac_curves({.tendon_toe_force = 1}), std::invalid_argument);
}

}  // namespace
}  // namespace risorius::muscle
