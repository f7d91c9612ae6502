// SPDX-License-Identifier: MIT
#include "risorius/contact/contact_law.h"

#include <gtest/gtest.h>

#include <string>

#include "contact/shapes.h"
#include "force_term_checks.h"
#include "geom/test_surfaces.h"
#include "risorius/contact/surface_samples.h"
#include "risorius/core/error.h"

namespace risorius::contact {
namespace {

TEST(ContactLaw, PressureIsTheSlopeOfTheEnergyAndHasASlopeItself) {
    const double t = 2e-3, h = 1e-7;  // central differences: the error is about 1e-10
    for (double gap = -6e-3; gap < 3e-3; gap += 1.7e-4) {
        const Penalty above = penalty(gap + h, t), below = penalty(gap - h, t);
        const Penalty at = penalty(gap, t);
        EXPECT_NEAR(at.pressure, -(above.energy - below.energy) / (2 * h), 1e-8) << gap;
        EXPECT_NEAR(at.slope, -(above.pressure - below.pressure) / (2 * h), 1e-4) << gap;
    }
}

TEST(ContactLaw, EnergyPressureAndSlopeDoNotJump) {
    for (const double gap : {0.0, 2e-3}) {
        const Penalty above = penalty(gap + 1e-12, 2e-3), below = penalty(gap - 1e-12, 2e-3);
        EXPECT_NEAR(above.energy, below.energy, 1e-12);
        EXPECT_NEAR(above.pressure, below.pressure, 1e-11);
        EXPECT_NEAR(above.slope, below.slope, 1e-8);
    }
}

TEST(ContactLaw, TheStiffnessForAPressureCarriesItWhereSurfacesMeet) {
    EXPECT_NEAR(stiffness_for(150, 2e-3) * penalty(0, 2e-3).pressure, 150, 1e-12);
}

TEST(ContactLaw, FrictionRisesToItsFullValueAtTheSlipSpeed) {
    const double e = 1e-4, h = 1e-9;
    for (double u = 1e-6; u < 3e-4; u += 7e-6) {
        const double slope =
            (slip_shape(u + h, e).potential - slip_shape(u - h, e).potential) / (2 * h);
        EXPECT_NEAR(slip_shape(u, e).force_over_slip * u, slope, 1e-6) << u;
        EXPECT_LE(slope, 1 + 1e-6);
    }
    EXPECT_NEAR(slip_shape(e, e).force_over_slip * e, 1, 1e-12);
    EXPECT_NEAR(slip_shape(5 * e, e).force_over_slip * 5 * e, 1, 1e-12);
}

TEST(ContactLaw, BadNumbersAreNamed) {
    try {
        check({.friction = -0.2}, "scene.json:/contact");
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(std::string(error.what()),
                  "scene.json:/contact/friction: expected [0, inf), found -0.2");
    }
}

TEST(SurfaceSamples, ShareTheAreaOfTheSurfaceAndItsMiddle) {
    const auto mesh = testing::box({0, 0, 0}, {1, 2, 3}, 2);
    for (const int per_side : {1, 2, 3, 5}) {
        double area = 0;
        Vec3 middle = Vec3::Zero();
        for (const ContactSample& sample :
             surface_samples(mesh.positions, mesh.triangles, per_side)) {
            EXPECT_NEAR(sample.point.weight_sum(), 1, 1e-14);
            area += sample.area_m2;
            middle += sample.area_m2 * sample.point.of(mesh.positions);
        }
        EXPECT_NEAR(area, 22, 1e-12);
        EXPECT_LT((middle / area - Vec3(0.5, 1, 1.5)).norm(), 1e-13);
    }
}

TEST(SurfaceSamples, CountEveryPlaceOnce) {
    const auto mesh = testing::box({0, 0, 0}, {1, 1, 1}, 1);  // 8 corners, 18 edges, 12 triangles
    EXPECT_EQ(surface_samples(mesh.positions, mesh.triangles, 1).size(), 8u);
    EXPECT_EQ(surface_samples(mesh.positions, mesh.triangles, 2).size(), 8u + 18u);
    EXPECT_EQ(surface_samples(mesh.positions, mesh.triangles, 3).size(), 8u + 2 * 18u + 12u);
    EXPECT_EQ(parts_per_side(mesh.positions, mesh.triangles, 0.5), 3)
        << "the longest side is a diagonal";
}

}  // namespace
}  // namespace risorius::contact
