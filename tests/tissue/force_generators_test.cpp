// SPDX-License-Identifier: MIT
#include "risorius/tissue/force_generators.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

#include "force_term_checks.h"
#include "risorius/core/error.h"

namespace risorius::tissue {
namespace {

using solve::NodeBlend;
using namespace testing_of;

const Pulse kBoxPulse{PulseShape::kBox, 3.0, 0.2, 0.5, 1.0, 0.0};
const Pulse kTrianglePulse{PulseShape::kTriangle, 3.0, 0.2, 0.5, 1.0, 0.0};
const Pulse kSinePulse{PulseShape::kSine, 3.0, 0.2, 0.5, 8.0, 0.3};  // four whole periods

TEST(Pulse, BoxGivesForceTimesDurationTriangleHalfOfItAndSineNothing) {
    EXPECT_NEAR(impulse_ns(kBoxPulse, 0, 1), 3.0 * 0.5, 1e-15);
    EXPECT_NEAR(impulse_ns(kTrianglePulse, 0, 1), 3.0 * 0.5 / 2, 1e-15);
    EXPECT_NEAR(impulse_ns(kSinePulse, 0, 1), 0, 1e-15);
}

TEST(Pulse, HasItsAmplitudeWhereItShould) {
    EXPECT_EQ(force_n(kBoxPulse, 0.2), 3.0);
    EXPECT_EQ(force_n(kBoxPulse, 0.69), 3.0);
    EXPECT_EQ(force_n(kBoxPulse, 0.71), 0.0);
    EXPECT_EQ(force_n(kBoxPulse, 0.19), 0.0);
    EXPECT_NEAR(force_n(kTrianglePulse, 0.45), 3.0, 1e-14);
    EXPECT_NEAR(force_n(kTrianglePulse, 0.325), 1.5, 1e-14);
    EXPECT_NEAR(force_n(kSinePulse, 0.25), 3.0 * std::sin(2 * std::numbers::pi * 8 * 0.05 + 0.3),
                1e-14);
    EXPECT_EQ(force_n(Pulse{}, 1e9), 1.0) << "a box without an end";
}

TEST(Pulse, ImpulseIsTheIntegralOfTheForceOverAnyInterval) {
    for (const Pulse& pulse : {kBoxPulse, kTrianglePulse, kSinePulse})
        for (const double from : {0.0, 0.21, 0.44})
            for (const double to : {0.3, 0.5, 0.68, 0.9}) {
                // Simpson's rule on a fine grid. Box ends inside an interval cause an error of one sample, 3 N / 20000.
                const int intervals = 20000;
                const double width = (to - from) / intervals;
                double sum = force_n(pulse, from) + force_n(pulse, to);
                for (int i = 1; i < intervals; ++i)
                    sum += (i % 2 ? 4 : 2) * force_n(pulse, from + i * width);
                EXPECT_NEAR(impulse_ns(pulse, from, to), sum * width / 3, 1e-4)
                    << "from " << from << " to " << to;
            }
}

TEST(ForceGenerators, PushAlongTheirDirectionWhateverItsLength) {
    const ForceGenerators generators({{NodeBlend({0, 1}, {0.25, 0.75}), {0, 2, 0}, kBoxPulse}});
    Points x = Points::Zero(2, 3), force = Points::Zero(2, 3);
    generators.add_force(0.3, x, x, force);
    EXPECT_DOUBLE_EQ(force(0, 1), 0.75);
    EXPECT_DOUBLE_EQ(force(1, 1), 2.25);
}

TEST(ForceGenerators, ForceIsMinusTheSlopeOfTheEnergy) {
    const ForceGenerators generators({{NodeBlend({0, 1}, {0.25, 0.75}), {1, 2, 0}, kSinePulse},
                                      {NodeBlend(2), {0, 0, -1}, kTrianglePulse}});
    const Points x = random_points(3, 1.0, 5);
    expect_force_is_minus_slope_of_energy(generators, 0.31, x, 1e-3, 1e-10);
    expect_gradient_of_potential(generators, {0.4, 0.1, x}, x, 1e-3, 1e-10);
}

TEST(ForceGenerators, ImplicitStepsPassOnTheWholeImpulseHoweverLongTheyAre) {
    const Points x = Points::Zero(1, 3);
    for (const Pulse& pulse : {kBoxPulse, kTrianglePulse, kSinePulse})
        for (const double step_s : {0.01, 0.07, 0.3, 5.0}) {
            const ForceGenerators generators({{NodeBlend(0), {0, 0, 1}, pulse}});
            double impulse = 0;
            for (int i = 1; i * step_s < 2 + step_s; ++i)
                impulse -=
                    step_s * potential_gradient(generators, {i * step_s, step_s, x}, x)(0, 2);
            EXPECT_NEAR(impulse, impulse_ns(pulse, 0, 10), 1e-13) << "step " << step_s;
        }
}

TEST(ForceGenerators, AnEquilibriumSeesTheForceOfItsTime) {
    const Points x = Points::Zero(1, 3);
    const ForceGenerators generators({{NodeBlend(0), {0, 0, 1}, kTrianglePulse}});
    const double forever = std::numeric_limits<double>::infinity();
    EXPECT_NEAR(potential_gradient(generators, {0.45, forever, x}, x)(0, 2), -3.0, 1e-14);
}

TEST(ForceGenerators, BadNumbersAreNamed) {
    const auto message = [](ForceGenerator generator) {
        try {
            check(generator, "body.json:/forces/0");
        } catch (const Error& error) {
            return std::string(error.what());
        }
        return std::string("accepted");
    };
    const ForceGenerator good{NodeBlend(0), {0, 0, 1}, kTrianglePulse};
    EXPECT_EQ(message(good), "accepted");
    ForceGenerator bad = good;
    bad.pulse.duration_s = 0;
    EXPECT_EQ(message(bad),
              "body.json:/forces/0/duration_s: expected (0, inf) for a triangle, found 0");
    bad = good;
    bad.direction.setZero();
    EXPECT_EQ(message(bad),
              "body.json:/forces/0/direction: expected a vector of length > 0, found 0");
    bad = good;
    bad.pulse.shape = PulseShape::kSine;
    bad.pulse.frequency_hz = -1;
    EXPECT_EQ(message(bad), "body.json:/forces/0/frequency_hz: expected (0, inf), found -1");
}

TEST(PulseShape, IsFoundByName) {
    EXPECT_EQ(pulse_shape_named("triangle"), PulseShape::kTriangle);
    EXPECT_THROW(pulse_shape_named("square"), std::invalid_argument);
}

}  // namespace
}  // namespace risorius::tissue
